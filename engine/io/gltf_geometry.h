// Internal to gltf_*.cpp: primitives to triangles.
#pragma once

#include "io/gltf_source.h"

#include <string>
#include <vector>

namespace blush {

// What of a primitive's vertices is wanted beside positions, normals and colours.
struct VertexNeeds {
    std::vector<int> uv_sets; // ascending
    int tangent_uv_set = -1;  // of the material's normal map, which needs tangents; -1: none
};

// Triangles of one primitive, with normals; of points and lines, those of small solids (gltf_points_lines.h). Null, with a finding in the
// report, if it has none to show.
// Triangles with a non-finite corner are left out with a warning.
// Errors: an index or accessor out of range, arrays of unlike length, no finite triangle at all.
Result<GeometryPtr> import_primitive(const GltfContext& context, const tinygltf::Primitive& primitive, const VertexNeeds& needs,
                                     const std::string& where);

} // namespace blush
