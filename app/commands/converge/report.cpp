#include "app/commands/converge/report.h"

#include "io/project/settings_json.h"
#include "measure/convergence/convergence_csv.h"

#include <fmt/format.h>

#include <fstream>
#include <thread>

namespace blush {
namespace {

OrderedJson if_known(bool known, double value) { return known ? OrderedJson(value) : OrderedJson(); }

OrderedJson point_json(const MeasuredPoint& p) {
    return {{"repeat", p.repeat},
            {"seconds", p.seconds},
            {"spp", p.spp},
            {"mse", p.metrics.mse},
            {"relmse", p.metrics.relmse},
            {"flip", if_known(p.has_flip, p.metrics.flip.mean)},
            {"mean", p.metrics.mean_a},
            {"reference_clearly_better", p.reference_clearly_better}};
}

OrderedJson bounces_json(const std::vector<RouletteBias>& bounces) {
    OrderedJson json = OrderedJson::array();
    for (const RouletteBias& b : bounces)
        json.push_back({{"bounce", b.name.substr(b.name.find(' ') + 1)},
                        {"share_percent", 100 * b.share},
                        {"percent", 100 * b.difference},
                        {"percent_error", 100 * b.error},
                        {"significant", b.significant}});
    return json;
}

OrderedJson bias_json(const VariantResult& v) {
    const BiasTest& b = v.bias;
    const RegionBias &w = b.worst, &p = b.pooled;
    return {{"z", b.whole.z()},
            {"verdict", b.verdict()},
            {"percent", b.whole.percent()},
            {"percent_error", if_known(b.whole.reference > 0, b.whole.percent_error())},
            {"pooled", {{"z", p.z()}, {"percent", p.percent()}, {"percent_error", if_known(p.reference > 0, p.percent_error())}}},
            {"threshold", b.threshold},
            {"regions", b.regions.size()},
            {"worst", {{"x", w.x}, {"y", w.y}, {"width", w.width}, {"height", w.height}, {"percent", w.percent()}, {"z", w.z()}}},
            {"bounces", bounces_json(v.bias_by_bounce)}};
}

OrderedJson variant_json(const VariantResult& v) {
    OrderedJson points = OrderedJson::array();
    for (const MeasuredPoint& p : v.points) points.push_back(point_json(p));
    const Interval &slope = v.over_seconds.slope, &spp = v.over_spp.slope;
    OrderedJson json;
    json["name"] = v.variant.name;
    json["options"] = v.variant.options;
    json["settings"] = OrderedJson::parse(render_settings_json(v.variant.settings), nullptr, false);
    json["points"] = points;
    json["slope"] = if_known(slope.known, slope.value);
    json["slope_low"] = if_known(slope.known, slope.low);
    json["slope_high"] = if_known(slope.known, slope.high);
    json["slope_spp"] = if_known(spp.known, spp.value);
    json["efficiency"] = if_known(v.efficiency.value > 0, v.efficiency.value);
    json["efficiency_low"] = if_known(v.efficiency.known, v.efficiency.low);
    json["efficiency_high"] = if_known(v.efficiency.known, v.efficiency.high);
    json["bias"] = bias_json(v);
    return json;
}

} // namespace

std::string machine_text() {
    std::string model = "unknown processor", line;
    std::ifstream cpus("/proc/cpuinfo");
    while (std::getline(cpus, line)) {
        if (!line.starts_with("model name")) continue;
        if (const size_t colon = line.find(": "); colon != line.npos) model = line.substr(colon + 2);
        break;
    }
    return fmt::format("{}, {} hardware threads", model, std::max(1u, std::thread::hardware_concurrency()));
}

std::string bias_by_bounce_text(const VariantResult& variant) {
    std::string text;
    for (const RouletteBias& b : variant.bias_by_bounce)
        if (b.significant) text += fmt::format("{}{} {:+.2g} %", text.empty() ? "" : ", ", b.name, 100 * b.difference);
    return text;
}

std::string converge_csv(const ConvergeReport& report) {
    std::string csv = "variant,seconds,spp,mse,relmse,flip,mean_r,mean_g,mean_b,repeat\n";
    for (const VariantResult& v : report.result.variants) {
        for (const MeasuredPoint& p : v.points) {
            const Metrics& m = p.metrics;
            csv += fmt::format("{},{:.6g},{},{:.8g},{:.8g},{},{:.8g},{:.8g},{:.8g},{}\n", csv_field(v.variant.name), p.seconds, p.spp,
                               m.mse, m.relmse, p.has_flip ? fmt::format("{:.6g}", m.flip.mean) : std::string(), m.mean_a[0], m.mean_a[1],
                               m.mean_a[2], p.repeat);
        }
    }
    return csv;
}

OrderedJson converge_json(const ConvergeReport& report) {
    OrderedJson variants = OrderedJson::array();
    for (const VariantResult& v : report.result.variants) variants.push_back(variant_json(v));
    const Reference& r = report.reference;
    OrderedJson json;
    json["scene"] = report.scene;
    json["preset"] = report.preset.empty() ? OrderedJson() : OrderedJson(report.preset);
    json["width"] = report.width;
    json["height"] = report.height;
    json["repeats"] = report.input.repeats;
    json["seed"] = report.input.seed;
    json["variants"] = variants;
    json["reference"] = {{"source", report.reference_source},
                         {"spp", r.measured.samples},
                         {"seed", r.seed},
                         {"seconds", r.seconds},
                         {"mse", mean_square_error(r.measured)}};
    json["kernel"] = report.result.kernel;
    json["machine"] = report.machine;
    json["version"] = report.build;
    json["partial"] = report.result.partial;
    return json;
}

} // namespace blush
