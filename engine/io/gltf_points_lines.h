// Internal to gltf_*.cpp: points and lines as what rays can meet, small balls and tubes.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace blush {

// Points and segments beyond are left out: each becomes some twenty triangles.
constexpr size_t most_points_and_segments = size_t(1) << 18;

struct Solids {
    Geometry geometry;  // with smooth normals and the other attributes of the vertices that it stands for
    float radius = 0;   // of balls and tubes, in the space of the mesh
    size_t shown = 0;   // points or segments
    size_t left_out = 0; // beyond the limit, with an end that is not finite, or of no length
};

// A radius that shows at any size: 1/500 of the diagonal of the box around the positions; of a single place, 5 mm.
float mark_radius(const PlacedVector<Vec3>& positions);

// Balls of twenty triangles around the vertices that `order` names, or tubes with six sides along its segments; `mode` is glTF's: 0 points,
// 1 lines, 2 a loop, 3 a strip. Indices are below the number of positions.
Solids solids_of(const Geometry& vertices, const std::vector<uint32_t>& order, int mode);

} // namespace blush
