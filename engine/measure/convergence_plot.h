// The runs as a chart: one curve for each kind of error that each shown run has, the guide, marks and the target.
#pragma once

#include "measure/convergence_runs.h"
#include "measure/plot.h"

#include <vector>

namespace blush {

struct ConvergencePlotOptions {
    ErrorMetric metric = ErrorMetric::rmse;
    ProgressAxis axis = ProgressAxis::seconds;
    double target = 0;    // of the metric; 0: none
    bool on_dark = false; // colours for a dark ground
};

struct ConvergencePlot {
    Plot plot;
    // What each curve of the plot shows; the guide, the last one, shows nothing and has none.
    struct Source {
        int run = 0;
        ConvergencePoint::Kind kind = ConvergencePoint::Kind::estimated;
        std::vector<ConvergencePoint> points; // of the curve, one for one
    };
    std::vector<Source> sources;
};

// The guide falls like 1/sqrt(N) for RMSE, 1/N for relMSE, through the first raw point of the live run, or of the first one shown.
ConvergencePlot convergence_plot(const ConvergenceRuns& runs, const ConvergencePlotOptions& options);

} // namespace blush
