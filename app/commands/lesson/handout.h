// A handout: a lesson with its pictures, error curves and measured claims, as one HTML file.
#pragma once

#include "app/commands/lesson/claims.h"
#include "color/color_management.h"
#include "measure/plot/plot.h"
#include "render/frame.h"

#include <atomic>
#include <string>
#include <vector>

namespace blush {

class Progress;

struct HandoutOptions {
    int size = 320;         // of the longer side of each picture, pixels
    int64_t spp = 64;       // of steps that set none
    bool spp_given = false; // then of all steps
    bool claims = true;     // measure them
    unsigned threads = 0;   // 0: one per core
};
constexpr int least_handout_size = 16, most_handout_size = 4096;

// A step as it is printed.
struct HandoutStep {
    std::vector<uint8_t> png;
    int width = 0, height = 0; // pixels
    int64_t samples = 0;       // per pixel, on average
    double seconds = 0;        // of rendering
    ErrorEstimate error;
    std::string bias;                  // why no number of samples gives the true image; empty: the estimator is unbiased
    std::string missing_light;         // as in Frame
    std::vector<PlotCurve::Point> rms; // RMSE against seconds, at growing numbers of samples
    std::vector<MeasuredClaim> claims; // of the step's, in order; empty: not measured
};

// Renders each step and measures its claims. Errors: an unknown view, interrupted.
Result<std::vector<HandoutStep>> measure_handout(const Lesson& lesson, const std::vector<Project>& states, const HandoutOptions& options,
                                                 const ColorManagement& color, Progress& progress, const std::atomic<bool>& interrupted);

// The page: no script, nothing to load, all text of the lesson escaped.
std::string handout_html(const Lesson& lesson, const std::vector<HandoutStep>& steps);

// Why images with these settings do not converge to the true image; empty if they do.
std::string bias_of_settings(const RenderSettings& settings);

// HTML of a text in Markdown: paragraphs, lists, emphasis and code; anything else is text.
std::string html_of_markdown(const std::string& markdown);

} // namespace blush
