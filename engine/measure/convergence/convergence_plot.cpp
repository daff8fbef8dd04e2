#include "measure/convergence/convergence_plot.h"

namespace blush {
namespace {

using Kind = ConvergencePoint::Kind;

PlotCurve style_of(Kind kind, const std::string& name, std::string color) {
    switch (kind) {
    case Kind::estimated: return {name, std::move(color), {}, PlotCurve::Line::solid, PlotCurve::Dots::filled};
    case Kind::measured: return {name + ", against the reference", std::move(color), {}, PlotCurve::Line::dotted, PlotCurve::Dots::filled};
    case Kind::denoised: return {name + ", denoised", std::move(color), {}, PlotCurve::Line::dashed, PlotCurve::Dots::hollow};
    }
    return {};
}

// Style of a measured curve in a run without estimates: stored runs have measured points only.
bool is_plain(Kind kind, const ConvergenceRecord& record) {
    return kind == Kind::estimated || (kind == Kind::measured && record.points(Kind::estimated).empty());
}

void add_curve(ConvergencePlot& p, const ConvergenceRun& run, Kind kind, const ConvergencePlotOptions& options) {
    const std::string color = options.on_dark ? plot_color_on_dark(run.color) : plot_color(run.color);
    PlotCurve curve = style_of(is_plain(kind, run.record) ? Kind::estimated : kind, run.record.name, color);
    ConvergencePlot::Source source{run.id, kind, {}};
    for (const ConvergencePoint& point : run.record.points(kind)) {
        const Interval& error = point.error(options.metric);
        if (!(error.value > 0) || !(point.at(options.axis) > 0)) continue;
        curve.points.push_back({point.at(options.axis), error.value, error.known ? error.low : 0, error.known ? error.high : 0});
        source.points.push_back(point);
    }
    if (curve.points.empty()) return;
    p.plot.curves.push_back(std::move(curve));
    p.sources.push_back(std::move(source));
}

} // namespace

ConvergencePlot convergence_plot(const ConvergenceRuns& runs, const ConvergencePlotOptions& options) {
    const bool rmse = options.metric == ErrorMetric::rmse;
    ConvergencePlot p;
    p.plot.x_label = options.axis == ProgressAxis::seconds ? "seconds of rendering" : "samples per pixel";
    p.plot.y_label = rmse ? "RMSE, scene-linear" : "relMSE";
    for (const ConvergenceRun& run : runs.all()) {
        if (!run.shown) continue;
        for (const Kind kind : {Kind::estimated, Kind::measured, Kind::denoised}) add_curve(p, run, kind, options);
        const std::string color = options.on_dark ? plot_color_on_dark(run.color) : plot_color(run.color);
        for (const ConvergenceMark& m : run.record.marks()) p.plot.marks.push_back({m.at(options.axis), m.label, color});
    }
    if (options.target > 0 && !p.plot.curves.empty()) p.plot.levels.push_back({options.target, "target"});
    if (p.sources.empty()) return p;
    const ConvergenceRun* live = runs.live();
    size_t along = 0;
    for (size_t i = p.sources.size(); i-- > 0;)
        if (live && p.sources[i].run == live->id && p.sources[i].kind == Kind::estimated) along = i;
    p.plot.curves.push_back(plot_guide(p.plot, rmse ? -0.5 : -1, rmse ? "1/√N" : "1/N", &p.plot.curves[along]));
    return p;
}

} // namespace blush
