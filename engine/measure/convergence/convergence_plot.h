// Convergence runs as a chart: one curve per run and kind of error, a guide line, marks and the target.
#pragma once

#include "measure/convergence/convergence_runs.h"
#include "measure/plot/plot.h"

#include <vector>

namespace blush {

struct ConvergencePlotOptions {
    ErrorMetric metric = ErrorMetric::rmse;
    ProgressAxis axis = ProgressAxis::seconds;
    double target = 0;    // of the metric; 0: none
    bool on_dark = false; // colours for a dark background
};

struct ConvergencePlot {
    Plot plot;
    // Source of each curve of the plot, except the guide, which is the last curve.
    struct Source {
        int run = 0;
        ConvergencePoint::Kind kind = ConvergencePoint::Kind::estimated;
        std::vector<ConvergencePoint> points; // one per point of the curve
    };
    std::vector<Source> sources;
};

// The guide has slope 1/sqrt(N) for RMSE, 1/N for relMSE, and starts at the first raw point of the live run or, without one, of
// the first shown run.
ConvergencePlot convergence_plot(const ConvergenceRuns& runs, const ConvergencePlotOptions& options);

} // namespace blush
