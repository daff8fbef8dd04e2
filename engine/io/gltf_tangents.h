// Tangent frames for meshes that have a normal map but no tangents.
#pragma once

#include "scene/scene.h"

namespace blush {

// Gives the geometry the tangents that MikkTSpace computes from one of its UV sets, which it must have beside normals. A vertex whose triangles
// do not agree, as where the halves of a mirrored texture meet, becomes several: copies are added behind all others.
// Returns of each added vertex which one it is a copy of.
std::vector<uint32_t> add_tangents(Geometry& geometry, int uv_set);

} // namespace blush
