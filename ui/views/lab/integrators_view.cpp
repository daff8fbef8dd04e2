#include "ui/views/lab/integrators_view.h"

#include "core/math.h"
#include "scene/affine.h"
#include "ui/snapshots/heat_map.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

PlotCurve curve_of(std::string name, std::string color, const ConvergenceRecord& record, ErrorMetric metric) {
    PlotCurve curve{std::move(name), std::move(color), {}};
    for (const ConvergencePoint& p : record.points())
        if (const Interval& e = p.error(metric); e.known) curve.points.push_back({p.seconds, e.value, e.low, e.high});
    return curve;
}

const char* name_of(ErrorMetric metric) { return metric == ErrorMetric::rmse ? "RMSE" : "relMSE"; }

// 0, 1 or 2: the third of `whole` in which the middle of a part lies.
int third(int from, int size, int whole) { return std::clamp(3 * (2 * from + size) / (2 * std::max(1, whole)), 0, 2); }

} // namespace

const char* integrator_name(ComparisonIntegrator::Kind kind) {
    return kind == ComparisonIntegrator::Kind::none ? "Path tracing" : integrator_names[size_t(kind) - 1];
}

std::vector<uint32_t> difference_texels(const IntegratorReport& r) {
    const Vec3 middle{0.2f, 0.2f, 0.2f}, dark{0.02f, 0.12f, 0.9f}, bright{0.9f, 0.06f, 0.02f};
    std::vector<uint32_t> texels;
    texels.reserve(r.path.image.size());
    for (size_t i = 0; i < std::min(r.path.image.size(), r.biased.image.size()); ++i) {
        const double b = luminance(to_double(r.biased.image[i])), p = luminance(to_double(r.path.image[i])), mean = (b + p) / 2;
        const float d = mean > 0 ? float(std::clamp((b - p) / mean / difference_range, -1.0, 1.0)) : 0;
        const Vec3& end = d < 0 ? dark : bright;
        texels.push_back(map_texel(middle * (1 - std::abs(d)) + end * std::abs(d)));
    }
    return texels;
}

std::string place_of(const RegionBias& region, const IntegratorReport& r) {
    constexpr const char *rows[] = {"top", "", "bottom"}, *columns[] = {"left", "", "right"};
    if (region.width == r.width && region.height == r.height) return "over the whole image";
    const int row = third(region.y, region.height, r.height), column = third(region.x, region.width, r.width);
    if (row == 1 && column == 1) return "in the middle";
    const std::string both =
        row != 1 && column != 1 ? fmt::format("{} {}", rows[row], columns[column]) : std::string(row != 1 ? rows[row] : columns[column]);
    return "at the " + both;
}

std::string amount_of(const RegionBias& region) {
    const double percent = std::abs(region.percent());
    return fmt::format("{:.{}f} % too {}", percent, percent < 0.995 ? 2 : percent < 99.5 ? 1 : 0, region.percent() < 0 ? "dark" : "bright");
}

std::string integrator_verdict(const IntegratorReport& r) {
    const BiasTest& t = r.verdict;
    if (t.regions.empty()) return "Too few samples for a verdict.";
    if (!t.biased)
        return fmt::format("No bias found in the noise so far: whole image {:+.2f} ± {:.2g} %.", t.whole.percent(),
                           t.whole.percent_error());
    const auto biased = std::ranges::count_if(t.regions, [&](const RegionBias& region) { return t.is_biased(region); });
    const auto most = std::ranges::max_element(
        t.regions, {}, [&](const RegionBias& region) { return t.is_biased(region) ? std::abs(region.percent()) : -1; });
    const RegionBias& shown = biased > 0 ? *most : t.worst;
    std::string text = fmt::format("Biased: {} {} (± {:.2g} %)", amount_of(shown), place_of(shown, r), shown.percent_error());
    if (biased > 0)
        text += fmt::format("; {} of {} regions differ, the whole image is {} (± {:.2g} %)", biased, t.regions.size(), amount_of(t.whole),
                            t.whole.percent_error());
    return text + ".";
}

std::string integrator_bias_text(const IntegratorReport& r, ComparisonIntegrator::Kind kind, ErrorMetric metric) {
    if (verdict_of(kind) == "unbiased") return "Unbiased by construction: its error is noise, which falls with the samples.";
    const Interval& b = r.bias(metric);
    if (!b.known) return fmt::format("Bias as {}: hidden by noise so far.", name_of(metric));
    return fmt::format("Bias as {}: {:.3g} ({:.3g} to {:.3g}) {}.", name_of(metric), b.value, b.low, b.high,
                       verdict_of(kind) == "consistent" ? "so far, and falls with the samples" : "stays, however long it renders");
}

std::string integrator_note(const IntegratorReport& r) {
    if (r.path.dropped + r.biased.dropped == 0) return {};
    return fmt::format("Samples that were not finite or negative are left out: {} of path tracing, {} of the other.", r.path.dropped,
                       r.biased.dropped);
}

Plot integrator_plot(const IntegratorReport& r, ComparisonIntegrator::Kind kind, ErrorMetric metric) {
    Plot plot;
    plot.title = fmt::format("{}, thin dashes: 1/{}", name_of(metric), metric == ErrorMetric::rmse ? "√N" : "N");
    plot.x_label = "core seconds";
    plot.curves.push_back(curve_of("Path tracing", plot_color_on_dark(0), r.path.noise, metric));
    plot.curves.push_back(curve_of(integrator_name(kind), plot_color_on_dark(1), r.error, metric));
    PlotCurve noise = curve_of("its noise alone", plot_color_on_dark(1), r.biased.noise, metric);
    noise.line = PlotCurve::Line::dotted;
    noise.dots = PlotCurve::Dots::hollow;
    plot.curves.push_back(std::move(noise));
    if (const Interval& b = r.bias(metric); b.known && verdict_of(kind) != "unbiased") plot.levels.push_back({b.value, "bias"});
    const PlotCurve& path = plot.curves.front();
    plot.curves.push_back(plot_guide(plot, metric == ErrorMetric::rmse ? -0.5 : -1, "", path.points.empty() ? nullptr : &path));
    return plot;
}

} // namespace blush
