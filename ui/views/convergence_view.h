// State of the Convergence panel: its data, settings and requests to the editor.
#pragma once

#include "measure/convergence/convergence_plot.h"

#include <array>
#include <optional>
#include <string>

namespace blush {

// CPU time of recording the live run so far, in seconds. Counted as if rendering had stopped meanwhile: an upper bound.
struct RecorderCost {
    double estimating = 0; // estimating errors from the half buffers of every frame; status bar and stop rules use them as well
    double recording = 0;  // on the UI thread
    double measuring = 0;  // measuring against a reference, or against the raw image
    double rendering = 0;
    double recorder_fraction() const { return rendering > 0 ? (recording + measuring) / rendering : 0; }
    double estimate_fraction() const { return rendering > 0 ? estimating / rendering : 0; }
};

// How the panel gets a reference.
struct ReferenceStatus {
    enum class State { none, looking, absent, rendering, stopping, there };
    State state = State::none;
    double progress = 0; // of rendering it
    int64_t spp = 0;     // if State::there: its samples per pixel and its own root mean squared error
    double rmse = 0;
    std::string problem; // for example why it could not be stored; may be empty
};

struct ConvergenceView {
    enum class Export { csv, svg, png };
    static constexpr const char* export_names[] = {"CSV", "SVG", "PNG"};

    bool open = false;
    ErrorMetric metric = ErrorMetric::rmse;
    ProgressAxis axis = ProgressAxis::seconds;
    std::array<float, 2> targets{}; // target of each metric; 0: none
    bool denoised = false;          // also record a curve of the denoised image
    bool reference = false;         // measure against a reference
    int renaming = 0;               // id of the run whose name is being edited
    std::string rename_text;

    // Updated by the editor.
    ConvergenceRuns runs;
    RecorderCost cost;
    ReferenceStatus reference_status;
    size_t waiting = 0; // number of denoised images whose error is not known yet

    // Executed by the editor after the panels are drawn.
    std::optional<Export> wanted_export;
    enum class ReferenceRequest { none, render, stop };
    ReferenceRequest wanted_reference = ReferenceRequest::none;

    double target() const { return double(targets[size_t(metric)]); }
    bool wants_denoised() const { return open && denoised; }
    ConvergencePlotOptions plot_options(bool on_dark) const { return {metric, axis, target(), on_dark}; }
};

// "0.0123 (0.0119 to 0.0127)", or without an interval "0.0123"; "not known yet".
std::string error_text(const Interval& error);
// "slope -0.49 (-0.52 to -0.46)"; "slope not known yet".
std::string slope_text(const Interval& slope);
// "target in 12 s (9.1 s to 16 s)", or why it cannot be predicted.
std::string time_left_text(const TimeLeft& left);
// A fraction of the render time in per cent, rounded up: "0.04 %".
std::string share_text(double share);
// Description of a point of a chart: run, kind, seconds, samples and error, one line each.
std::string readout_text(const std::string& run, const ConvergencePoint& point, ErrorMetric metric);

} // namespace blush
