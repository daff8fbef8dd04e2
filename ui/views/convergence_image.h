// The convergence chart as an image file: on white, with its own legend.
#pragma once

#include "ui/views/convergence_view.h"

#include <string>
#include <vector>

namespace blush {

// With the panel's settings; the title is the scene's name.
ConvergencePlot export_chart(const ConvergenceView& view, const std::string& scene);

// Display-encoded RGB in [0, 1], width * height * 3, drawn with the UI fonts.
struct ChartImage {
    int width = 0, height = 0;
    std::vector<float> rgb;
};
ChartImage draw_chart_image(const Plot& plot);

} // namespace blush
