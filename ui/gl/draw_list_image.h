// Rasterizes an ImGui draw list to pixels, without a window or OpenGL: for image files.
#pragma once

#include <imgui.h>
#include <vector>

namespace blush {

// Draws the triangles of a list, textured by the font atlas, over a background. Returns display-encoded RGB in [0, 1], width *
// height * 3, top row first. Respects clip rectangles; ignores callbacks and other textures.
std::vector<float> rasterize(const ImDrawList& list, int width, int height, ImU32 ground);

} // namespace blush
