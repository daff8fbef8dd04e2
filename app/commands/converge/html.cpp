// The report of `blush converge` as one self-contained HTML file.
#include "app/commands/converge/report.h"

#include "app/commands/base64.h"
#include "core/text.h"
#include "io/image/display_image.h"
#include "io/image/image_io.h"
#include "measure/convergence/convergence.h"
#include "measure/plot/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace blush {
namespace {

constexpr int max_thumbnail_width = 400; // pixels

constexpr const char* style = R"(
body{font:15px/1.5 system-ui,sans-serif;color:#222;background:#fff;max-width:1340px;margin:2rem auto;padding:0 1.5rem}
h1{font-size:1.6rem;margin:0 0 .3rem} h2{font-size:1.15rem;margin:2rem 0 .6rem} p{max-width:50rem;margin:.5rem 0} .quiet{color:#666}
.row{display:flex;flex-wrap:wrap;gap:1.2rem} figure{margin:0} figcaption{font-size:.88rem;color:#444} img{display:block;border:1px solid #ddd}
table{border-collapse:collapse;font-size:.9rem;font-variant-numeric:tabular-nums} th,td{padding:.3rem .8rem;border-bottom:1px solid #ddd;text-align:right}
th:first-child,td:first-child{text-align:left} thead th{border-bottom:2px solid #999;font-weight:600} td small{color:#666;display:block} td:first-child{min-width:11rem} .interval{white-space:nowrap}
.swatch{display:inline-block;width:.8em;height:.8em;margin-right:.5em;border-radius:2px} .biased{color:#a33000;font-weight:600}
svg{max-width:100%;height:auto} code{font-size:.9em;overflow-wrap:anywhere} dl{display:grid;grid-template-columns:max-content 1fr;gap:.2rem 1rem;font-size:.9rem} dd{margin:0}
@media print{body{margin:0;max-width:none;font-size:11pt} h2{break-after:avoid} figure,tr{break-inside:avoid}}
)";

// Averages square blocks of pixels, to at most the width of a thumbnail.
RgbImage shrunk(const RgbImage& image) {
    const int k = (image.width + max_thumbnail_width - 1) / max_thumbnail_width;
    RgbImage small{std::max(1, image.width / k), std::max(1, image.height / k), {}};
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
            Vec3d sum{0, 0, 0};
            int count = 0;
            for (int j = y * k; j < std::min(image.height, (y + 1) * k); ++j) {
                for (int i = x * k; i < std::min(image.width, (x + 1) * k); ++i, ++count) {
                    const Vec3& p = image.pixels[size_t(j) * size_t(image.width) + size_t(i)];
                    sum = {sum.x + double(p.x), sum.y + double(p.y), sum.z + double(p.z)};
                }
            }
            small.pixels.push_back({float(sum.x / count), float(sum.y / count), float(sum.z / count)});
        }
    }
    return small;
}

Result<std::string> figure(const RgbImage& image, const std::string& caption, const ColorManagement& color, const ViewSettings& view) {
    const RgbImage small = shrunk(image);
    std::vector<float> rgb;
    for (const Vec3& p : small.pixels) rgb.insert(rgb.end(), {p.x, p.y, p.z});
    if (Result<void> shown = show(color, view, rgb); !shown) return shown.error();
    const Result<std::vector<uint8_t>> png = encode_png(small.width, small.height, rgb);
    if (!png) return png.error();
    return fmt::format("<figure style='width:{0}px'><img width='{0}' height='{1}' alt='{2}' src='data:image/png;base64,{3}'>"
                       "<figcaption>{2}</figcaption></figure>\n",
                       small.width, small.height, escaped_markup(caption), base64(*png));
}

// One curve per repeat in the variant's colour; only the first is in the legend.
Plot error_plot(const ConvergeReport& report, const std::string& title, const std::string& x_label, double (*x_of)(const MeasuredPoint&)) {
    Plot plot{title, x_label, "RMSE against the reference", {}, {}, {}};
    for (size_t v = 0; v < report.result.variants.size(); ++v) {
        const VariantResult& variant = report.result.variants[v];
        for (const MeasuredPoint& p : variant.points) {
            const bool begins = &p == &variant.points.front() || (&p)[-1].repeat != p.repeat;
            if (begins) plot.curves.push_back({p.repeat == 0 ? variant.variant.name : "", plot_color(v), {}});
            plot.curves.back().points.push_back({x_of(p), p.metrics.rmse});
        }
    }
    const PlotCurve guide = plot_guide(plot, -0.5, "1/√N (reference slope)");
    PlotCurve floor{"error of the reference", "#bbbbbb", {}, PlotCurve::Line::dashed, PlotCurve::Dots::none};
    const double own = std::sqrt(mean_square_error(report.reference.measured));
    for (const PlotCurve::Point& p : guide.points) floor.points.push_back({p.x, own});
    plot.curves.push_back(guide);
    if (own > 0) plot.curves.push_back(floor);
    return plot;
}

std::string with_interval(const Interval& i) {
    if (!i.known) return i.value != 0 ? fmt::format("{:.3g}", i.value) : std::string("–");
    return fmt::format("{:.3g}<small class='interval'>{:.3g} to {:.3g}</small>", i.value, i.low, i.high);
}

std::string bias_cell(const VariantResult& v) {
    const BiasTest& b = v.bias;
    const RegionBias &w = b.worst, &p = b.pooled;
    const bool whole_is_worst = w.width == b.whole.width && w.height == b.whole.height;
    const std::string region = whole_is_worst ? std::string()
                                              : fmt::format("<small>most in {}×{} at {},{}: {:+.3g} %, z {}</small>", w.width, w.height,
                                                            w.x, w.y, w.percent(), signed_number(w.z(), 1));
    const std::string pooled = std::abs(p.z()) <= std::abs(b.whole.z())
                                   ? std::string()
                                   : fmt::format("<small>weighted by the precision of the reference {:+.3g} % ± {:.2g}, z {}</small>",
                                                 p.percent(), 1.96 * p.percent_error(), signed_number(p.z(), 1));
    std::string bounces = bias_by_bounce_text(v);
    if (!bounces.empty()) bounces = fmt::format("<small>{}</small>", bounces);
    return fmt::format("<td{}>{}<small>whole image {:+.3g} % ± {:.2g}, z {}</small>{}{}{}</td>", b.biased ? " class='biased'" : "",
                       b.verdict(), b.whole.percent(), 1.96 * b.whole.percent_error(), signed_number(b.whole.z(), 1), pooled, region,
                       bounces);
}

std::string variant_row(const VariantResult& v, size_t index) {
    if (v.points.empty()) return fmt::format("<tr><td>{}</td><td colspan='8'>not measured</td></tr>\n", escaped_markup(v.variant.name));
    const MeasuredPoint& p = v.points.back();
    const auto flip = std::find_if(v.points.rbegin(), v.points.rend(), [](const MeasuredPoint& m) { return m.has_flip; });
    return fmt::format("<tr><td><span class='swatch' "
                       "style='background:{}'></span>{}<small><code>{}</code></small></td><td>{}</td><td>{:.3g}</td><td>{:.3g}{}</td>"
                       "<td>{:.3g}</td><td>{}</td><td>{}</td><td>{}</td>{}</tr>\n",
                       plot_color(index), escaped_markup(v.variant.name), escaped_markup(v.variant.options), p.spp, p.seconds,
                       p.metrics.rmse, p.reference_clearly_better ? "" : "<small>not above the reference's error</small>", p.metrics.relmse,
                       flip == v.points.rend() ? std::string("–") : fmt::format("{:.3g}", flip->metrics.flip.mean),
                       with_interval(v.over_seconds.slope), with_interval(v.efficiency), bias_cell(v));
}

std::string table(const ConvergeReport& report) {
    std::string html =
        "<table><thead><tr><th>Variant</th><th>samples<br>per pixel</th><th>seconds</th><th>RMSE</th><th>relMSE</th><th>FLIP</th>"
        "<th>slope</th><th>efficiency<br>1/(MSE·s)</th><th>bias test, all repeats</th></tr></thead><tbody>\n";
    for (size_t i = 0; i < report.result.variants.size(); ++i) html += variant_row(report.result.variants[i], i);
    return html + "</tbody></table>\n";
}

std::string how_to_read(const ConvergeReport& report) {
    const bool capped = std::ranges::any_of(report.result.variants, [&](const VariantResult& v) {
        return v.variant.settings.max_bounces != unlimited_bounces && v.bias.biased;
    });
    const bool cut = std::ranges::any_of(report.result.variants, [](const VariantResult& v) {
        return v.variant.settings.roulette.rule == Roulette::Rule::biased_cut && v.bias.biased;
    });
    std::string html = fmt::format(
        "<p>Both axes are logarithmic. Pure Monte Carlo noise falls with one over the square root of the number of samples: a line of "
        "slope −½. "
        "Stratified samples of a smooth integrand converge faster. A lower curve is better at that time. A curve that "
        "levels off is biased, or has reached the error of its reference. Variants were rendered in "
        "alternating slices of a tenth of a second, so that other load on the machine affected all equally; each was rendered {} "
        "times. The time to measure is not included. Efficiency is 1 / (MSE × seconds): twice the efficiency is the same "
        "error in half the time. "
        "Intervals are 95 % confidence intervals, over the repeats for efficiency. Fits exclude points at which the reference is not "
        "clearly better.</p>\n",
        report.input.repeats);
    html += fmt::format(
        "<p>The bias test compares the means of the whole image and of a grid of regions with the reference, in units of the standard "
        "error of the "
        "difference. Its false positive rate over all regions of a variant is at most {:g} % (Šidák correction). An image is "
        "not called biased "
        "if its missing light can be explained by rare bright samples, as bright as the brightest it has found. The bias per bounce of a "
        "biased "
        "variant is measured separately, with the same random numbers and without roulette and limit, in per cent of all light."
        "</p>\n",
        100 * bias_significance);
    if (capped)
        html += "<p>A limit on bounces is biased: the light of all longer paths is missing, for any number of samples, and "
                "the curve "
                "levels off at that error.</p>\n";
    if (cut)
        html += "<p>The biased cut terminates paths of low throughput without compensation, so their light is missing. "
                "Russian roulette divides the throughput of "
                "survivors by the survival probability, which preserves the mean.</p>\n";
    return html;
}

std::string about(const ConvergeReport& report) {
    const Reference& r = report.reference;
    std::string html = "<dl>\n";
    const auto row = [&](const char* what, const std::string& value) {
        html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", what, escaped_markup(value));
    };
    row("scene", fmt::format("{}, {} × {} pixels", report.scene, report.width, report.height));
    row("budget", report.input.spp > 0 ? fmt::format("{} samples per pixel, {} repeats", report.input.spp, report.input.repeats)
                                       : fmt::format("{:g} s, {} repeats", report.input.seconds, report.input.repeats));
    row("seeds", fmt::format("{} to {}", report.input.seed, report.input.seed + uint32_t(report.input.repeats) - 1));
    row("reference", fmt::format("{}; {} samples per pixel, seed {}, {:.3g} s, own RMSE {:.3g}", report.reference_source,
                                 r.measured.samples, r.seed, r.seconds, std::sqrt(mean_square_error(r.measured))));
    row("kernel", report.result.kernel);
    row("machine", report.machine);
    row("program", "Blush " + report.build);
    return html + "</dl>\n";
}

} // namespace

Result<std::string> converge_html(const ConvergeReport& report, const ColorManagement& color, const ViewSettings& view) {
    std::string html =
        "<!DOCTYPE html>\n<html lang='en'>\n<head><meta charset='utf-8'><meta name='viewport' content='width=device-width'>\n";
    html += fmt::format("<title>Convergence: {}</title>\n<style>{}</style></head>\n<body>\n", escaped_markup(report.scene), style);
    html += fmt::format("<h1>Error against run time: {}</h1>\n<p class='quiet'>{} × {} pixels, {} variants{}{}</p>\n",
                        escaped_markup(report.scene), report.width, report.height, report.result.variants.size(),
                        report.preset.empty() ? "" : ", preset " + escaped_markup(report.preset),
                        report.result.partial ? ". <strong>Ended early: partial.</strong>" : "");
    html += "<div class='row'>\n";
    html += to_svg(error_plot(report, "Error against time", "seconds of rendering", [](const MeasuredPoint& p) { return p.seconds; }));
    html += to_svg(error_plot(report, "Error against samples", "samples per pixel", [](const MeasuredPoint& p) { return double(p.spp); }));
    html += "</div>\n<h2>At the end of the last repeat</h2>\n" + table(report) + "<h2>How to read this</h2>\n" + how_to_read(report) +
            "<h2>Images</h2>\n<div class='row'>\n";
    for (const VariantResult& v : report.result.variants) {
        if (v.mean.samples == 0) continue;
        const Result<std::string> shown =
            figure(v.mean.image, fmt::format("{}, all repeats, {} spp", v.variant.name, v.mean.samples), color, view);
        if (!shown) return shown.error();
        html += *shown;
    }
    const MeasuredImage& reference = report.reference.measured;
    const Result<std::string> shown = figure(reference.image, fmt::format("reference, {} spp", reference.samples), color, view);
    if (!shown) return shown.error();
    html += *shown + "</div>\n<h2>Settings, machine, build</h2>\n" + about(report);
    return html + "</body>\n</html>\n";
}

} // namespace blush
