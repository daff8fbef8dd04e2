// How large meshes are traced.
#pragma once

#include <cstddef>

namespace blush {

// Leaves of the ray tracer's trees hold the corners of their triangles, or, in larger meshes, their indices alone: that saves 27 bytes a triangle,
// 50 while the tree is built and a third of the time to build it, and a picture takes a quarter longer (a closed room of a million triangles).
constexpr size_t most_triangles_with_corners = size_t(1) << 19;

} // namespace blush
