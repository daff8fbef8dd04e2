// A chart drawn by ImGui, from the same layout as its SVG.
#pragma once

#include "measure/plot_layout.h"

#include <imgui.h>

namespace blush {

struct PlotTones {
    ImU32 ground, text, dim_text, box, major, minor;
};
PlotTones plot_tones_dark();  // for the window
PlotTones plot_tones_paper(); // for files

// Sizes and letters of `font` at `font_size` pixels.
PlotMetrics plot_metrics(ImVec2 size, const ImFont& font, float font_size, bool legend);

// The upper left corner of the layout at `origin`.
void draw_plot(ImDrawList& draw, const Plot& plot, const PlotLayout& layout, ImVec2 origin, const ImFont& font, float font_size,
               const PlotTones& tones);

// A sample of a curve's line, `length` pixels from `at` to the right.
void draw_line_sample(ImDrawList& draw, PlotCurve::Line line, ImVec2 at, float length, ImU32 color, float font_size);

// "#rrggbb"; black for anything else.
ImU32 parse_color(const std::string& text, float alpha = 1);

} // namespace blush
