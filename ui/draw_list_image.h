// What ImGui was told to draw, as pixels, without a window or OpenGL: for pictures that go into files.
#pragma once

#include <imgui.h>
#include <vector>

namespace blush {

// Triangles of a list, textured by the font atlas, over a ground: display-encoded RGB in [0, 1], width * height * 3, top row first. Clip
// rectangles hold; callbacks and other textures are left out.
std::vector<float> rasterize(const ImDrawList& list, int width, int height, ImU32 ground);

} // namespace blush
