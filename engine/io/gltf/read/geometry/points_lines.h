// Internal to io/gltf: tessellates points and lines as small spheres and tubes, so that they can be ray traced.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <span>

namespace blush {

// Limit of points and segments: each becomes about twenty triangles.
constexpr size_t max_points_and_segments = size_t(1) << 18;

struct Solids {
    Geometry geometry;   // with smooth normals and the other attributes of the source vertices
    float radius = 0;    // of spheres and tubes, in mesh space
    size_t shown = 0;    // points or segments converted
    size_t left_out = 0; // skipped: beyond the limit, not finite, or of zero length
};

// Radius relative to the size of the primitive: 1/500 of the diagonal of its bounding box; 5 mm for a single position.
float mark_radius(const GeometryArray<Vec3>& positions);

// Spheres of twenty triangles around the vertices in `order`, or tubes with six sides along its segments; `mode` is glTF's: 0
// points, 1 lines, 2 a loop, 3 a strip. Indices are below the number of positions.
Solids solids_of(const Geometry& vertices, std::span<const uint32_t> order, int mode);

} // namespace blush
