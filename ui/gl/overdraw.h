// Reduces overdraw for software rasterizers. Filling a window's background with ImGui's shader, texture and blending takes four
// times as long as clearing, and pixels below other windows are filled without need. Not
// significant with a GPU.
#pragma once

#include <imgui.h>

namespace blush {

// Changes the draw commands but not the result. The opaque background of each window is cleared by commands that need OpenGL when
// drawn. In the lists below it, commands that are fully covered are removed; commands with few triangles are clipped to their
// visible parts. `data` is ImGui's draw data after Render(), drawn before the next frame.
void reduce_overdraw(ImDrawData& data);

// If the command clears its clip rectangle: the colour.
bool is_clearing(const ImDrawCmd& command);
ImU32 clearing_color(const ImDrawCmd& command);

} // namespace blush
