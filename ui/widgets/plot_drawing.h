// Draws a chart with ImGui, from the same layout as its SVG.
#pragma once

#include "measure/plot/plot_layout.h"

#include <imgui.h>

namespace blush {

struct PlotTones {
    ImU32 ground, text, dim_text, box, major, minor;
};
PlotTones plot_tones_dark();  // for the window
PlotTones plot_tones_paper(); // for image files

// Font metrics of `font` at `font_size` pixels.
PlotMetrics plot_metrics(ImVec2 size, const ImFont& font, float font_size, bool legend);

// `origin` is the upper left corner of the layout.
void draw_plot(ImDrawList& draw, const Plot& plot, const PlotLayout& layout, ImVec2 origin, const ImFont& font, float font_size,
               const PlotTones& tones);

// A line sample for the legend, `length` pixels from `at` to the right.
void draw_line_sample(ImDrawList& draw, PlotCurve::Line line, ImVec2 at, float length, ImU32 color, float font_size);

// Parses "#rrggbb"; black if invalid.
ImU32 parse_color(const std::string& text, float alpha = 1);

} // namespace blush
