// What a software rasteriser need not fill. Through ImGui's shader, texture and blending a window's ground takes it four times as long as
// clearing, and what lies below a window it would fill in vain: a graphics card does not notice, a frame without one does.
#pragma once

#include <imgui.h>

namespace blush {

// Changes what is to be drawn, not what is seen. The opaque ground of each window is cleared, by commands that need OpenGL when they are
// drawn; of the lists below it nothing is drawn that it covers: commands that it covers wholly are left out, those of a few triangles are
// clipped to what is left of them. `data` is ImGui's after Render(), and is drawn before the next frame.
void spare_fill(ImDrawData& data);

// Is it a clearing of its clip rectangle, and in what colour?
bool is_clearing(const ImDrawCmd& command);
ImU32 clearing_color(const ImDrawCmd& command);

} // namespace blush
