#include "ui/views/lab/strategies_view.h"

#include "ui/snapshots/heat_map.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <imgui.h>

namespace blush {
namespace {

using Show = StrategiesView::Show;

constexpr double decades = 6;
constexpr double left_out = 0.001; // of the pixels, above the scale

// Null: the strategy has no such map.
const std::vector<float>* variance_of(const StrategyReport& r, Show show, size_t k) {
    if (show == Show::variance) return &r.sides[k].variance;
    if (show == Show::mis_variance) return k < r.parts.size() ? &r.parts[k].variance : &r.mis().variance;
    return nullptr;
}

// Two digits without an exponent where that is short.
std::string short_number(double v) { return v >= 10 && v < 1e6 ? fmt::format("{:.0f}", v) : fmt::format("{:.2g}", v); }

uint32_t grey(float weight) {
    const int v = int(255 * std::clamp(weight, 0.f, 1.f) + 0.5f);
    return uint32_t(IM_COL32(v, v, v, 255));
}

// Bytes of "#rrggbb".
Vec3 bytes_of(const std::string& color) {
    const unsigned long rgb = std::stoul(color.substr(1), nullptr, 16);
    return {float(rgb >> 16 & 255), float(rgb >> 8 & 255), float(rgb & 255)};
}

std::vector<uint32_t> weight_texels(const StrategyReport& r) {
    std::vector<uint32_t> texels;
    for (const MisPart& part : r.parts)
        for (const float w : part.weight) texels.push_back(grey(w));
    const Vec3 a = bytes_of(strategy_color(0)), b = bytes_of(strategy_color(1));
    for (size_t i = 0; i < r.parts[0].weight.size(); ++i) {
        const Vec3 mixed = a * r.parts[0].weight[i] + b * r.parts[1].weight[i];
        texels.push_back(uint32_t(IM_COL32(int(mixed.x), int(mixed.y), int(mixed.z), 255)));
    }
    return texels;
}

} // namespace

std::string strategy_color(size_t strategy) { return plot_color_on_dark(strategy); }

VarianceScale variance_scale(const StrategyReport& r, Show show) {
    std::vector<float> all;
    for (size_t k = 0; k < r.sides.size(); ++k)
        if (const std::vector<float>* v = variance_of(r, show, k)) all.insert(all.end(), v->begin(), v->end());
    if (all.empty()) return {};
    const auto at = all.begin() + std::ptrdiff_t(double(all.size() - 1) * (1 - left_out));
    std::nth_element(all.begin(), at, all.end());
    return {double(*at) * std::pow(10, -decades), double(*at)};
}

std::vector<uint32_t> strategy_texels(const StrategyReport& r, Show show) {
    if (show == Show::mis_weight) return weight_texels(r);
    const VarianceScale scale = variance_scale(r, show);
    std::vector<uint32_t> texels;
    if (!(scale.high > 0)) return texels;
    for (size_t k = 0; k < r.sides.size(); ++k)
        for (const float v : *variance_of(r, show, k))
            texels.push_back(map_texel(heat_map_color(v > 0 ? float(std::log10(double(v) / scale.low) / decades) : 0)));
    return texels;
}

std::string strategy_caption(const StrategyReport& r, Show show) {
    const double bsdf = 100 * r.parts[0].share, light = 100 * r.parts[1].share;
    switch (show) {
    case Show::image:
        return bsdf + light > 0 ? fmt::format("MIS finds {:.1f} % of the light by BSDF sampling, {:.1f} % by light sampling.", bsdf, light)
                                : "MIS finds no light.";
    case Show::mis_weight: return fmt::format("Black 0, white 100 % of a pixel. Whole image: {:.1f} % BSDF, {:.1f} % light.", bsdf, light);
    case Show::variance:
    case Show::mis_variance: break;
    }
    const VarianceScale scale = variance_scale(r, show);
    if (!(scale.high > 0)) return "No variance is known yet.";
    return fmt::format("Of one sample{}: black {}, red {}, white {} nits².", show == Show::variance ? "" : " in MIS",
                       short_number(scale.low), short_number(scale.low * std::pow(10, decades / 2)), short_number(scale.high));
}

Plot strategy_plot(const StrategyReport& r, ErrorMetric metric) {
    Plot plot;
    plot.title = metric == ErrorMetric::rmse ? "RMSE, dashed: 1/√N" : "relMSE, dashed: 1/N";
    plot.x_label = "core seconds";
    for (size_t k = 0; k < r.sides.size(); ++k) {
        PlotCurve curve{strategy_names[k], strategy_color(k), {}};
        for (const ConvergencePoint& p : r.sides[k].record.points())
            if (const Interval& e = p.error(metric); e.known) curve.points.push_back({p.seconds, e.value, e.low, e.high});
        plot.curves.push_back(std::move(curve));
    }
    const PlotCurve& mis = plot.curves.back();
    plot.curves.push_back(plot_guide(plot, metric == ErrorMetric::rmse ? -0.5 : -1, "", mis.points.empty() ? nullptr : &mis));
    return plot;
}

std::vector<std::string> strategy_notes(const StrategyReport& r) {
    std::vector<std::string> notes;
    if (r.zero_size_lights > 0)
        notes.push_back(fmt::format("BSDF sampling cannot find lights without size: {} of them. NEE samples {} in all three images.",
                                    r.zero_size_lights, r.zero_size_lights == 1 ? "it" : "them"));
    for (size_t k = 0; k < r.sides.size(); ++k)
        if (r.sides[k].dropped > 0)
            notes.push_back(
                fmt::format("{}: {} samples were not finite or negative and are left out.", strategy_names[k], r.sides[k].dropped));
    return notes;
}

} // namespace blush
