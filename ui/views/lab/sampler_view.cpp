#include "ui/views/lab/sampler_view.h"

#include <fmt/format.h>

namespace blush {

Plot sampler_plot(const SamplerReport& report) {
    Plot plot;
    plot.x_label = "samples per pixel";
    plot.y_label = "RMSE, nits";
    for (size_t i = 0; i < sampler_names.size(); ++i) {
        PlotCurve curve{.name = sampler_names[i], .color = plot_color_on_dark(i), .points = {}};
        for (size_t k = 0; k < compared_sample_counts.size(); ++k)
            if (const Interval& e = report.sides[i][k]; e.known)
                curve.points.push_back({double(compared_sample_counts[k]), e.value, e.low, e.high});
        plot.curves.push_back(std::move(curve));
    }
    if (!plot.curves[0].points.empty()) plot.curves.push_back(plot_guide(plot, -0.5, "1/sqrt(N)", &plot.curves[0]));
    return plot;
}

std::string sampler_gain_text(const SamplerReport& report) {
    for (size_t k = compared_sample_counts.size(); k-- > 0;) {
        const Interval& g = report.gains[k];
        if (!g.known) continue;
        return fmt::format("At {} samples per pixel: random numbers have {:.3g} times the mean squared error ({:.3g} to {:.3g}) of Sobol "
                           "points, so they need about that many times the samples.",
                           compared_sample_counts[k], g.value, g.low, g.high);
    }
    return {};
}

} // namespace blush
