// UI theme: neutral greys, so that it does not influence the perception of the image's colours.
#pragma once

#include "core/vec.h"

#include <filesystem>
#include <imgui.h>

namespace blush {

// Loads Inter from `assets`/fonts or the system's fonts, else DejaVu Sans, else ImGui's font. The first font is the text font,
// the second the semibold one for headings.
void load_fonts(const std::filesystem::path& assets, float scale);
ImFont* heading_font();

void apply_theme(float scale);

// A linear colour, display-encoded, scaled to full brightness.
ImU32 hue_of(const Vec3& linear, int alpha = 255);

namespace tone {
constexpr ImU32 text = IM_COL32(214, 214, 214, 255);
constexpr ImU32 dim_text = IM_COL32(140, 140, 140, 255);
constexpr ImU32 surround = IM_COL32(28, 28, 28, 255); // around the image
constexpr ImU32 field = IM_COL32(58, 58, 58, 255);
constexpr ImU32 field_hovered = IM_COL32(68, 68, 68, 255);
constexpr ImU32 field_filled = IM_COL32(92, 92, 92, 255); // the part of a slider below its value
constexpr ImU32 line = IM_COL32(24, 24, 24, 255);
constexpr ImU32 accent = IM_COL32(255, 158, 51, 255); // only for the selection in the viewport
constexpr ImU32 warning = IM_COL32(235, 185, 90, 255);
constexpr ImU32 failure = IM_COL32(240, 110, 95, 255);
constexpr ImU32 axis_x = IM_COL32(226, 92, 84, 255), axis_y = IM_COL32(128, 190, 76, 255), axis_z = IM_COL32(86, 146, 232, 255);
constexpr ImU32 light = IM_COL32(250, 226, 150, 255);
} // namespace tone

} // namespace blush
