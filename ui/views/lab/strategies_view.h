// State of the Strategies panel, and what it shows of a report: charts, maps and texts.
#pragma once

#include "measure/plot/plot.h"
#include "ui/jobs/strategy_runner.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace blush {

struct StrategiesView {
    enum class Show { image, variance, mis_weight, mis_variance };
    static constexpr const char* show_names[] = {"Image", "Variance", "MIS weight", "MIS variance"};

    bool open = false;
    Show show = Show::image;
    ErrorMetric metric = ErrorMetric::relmse; // lamps that are seen directly do not outweigh the rest
    StrategyBudget budget = StrategyBudget::time;
    std::shared_ptr<StrategyRunner> runner; // while the panel is open
    StrategyRunner::State state;            // last polled
};

// In the order of compared_strategies.
constexpr const char* strategy_names[] = {"BSDF sampling", "Light sampling (NEE)", "MIS"};
// Of its curve and in the map of MIS weights, on a dark background: "#rrggbb".
std::string strategy_color(size_t strategy);

// The range of a heat map on a logarithmic scale, nits^2; `high` is 0 if there is nothing to show.
struct VarianceScale {
    double low = 0, high = 0;
};
// One scale for the three maps: from their brightest pixels, without the brightest thousandth, six decades down.
VarianceScale variance_scale(const StrategyReport& report, StrategiesView::Show show);

// The maps of the three strategies one below the other, width * 3 height RGBA bytes, top row first; empty for Show::image, which needs
// the display transform, and while there are no variances.
// Variance: a heat map. MIS weight: grey from 0 to 1 for the two strategies, and for MIS the mixture of their colours.
std::vector<uint32_t> strategy_texels(const StrategyReport& report, StrategiesView::Show show);
// What is shown, in one line: the scale of the maps, and what MIS finds by which strategy.
std::string strategy_caption(const StrategyReport& report, StrategiesView::Show show);

// Error of the three strategies over time, on logarithmic axes, with the slope of independent samples as the last curve; the title
// explains it. Errors that are not known have no point.
Plot strategy_plot(const StrategyReport& report, ErrorMetric metric);

// What the numbers do not say: lights that BSDF sampling cannot find, samples that were left out. Empty: nothing.
std::vector<std::string> strategy_notes(const StrategyReport& report);

} // namespace blush
