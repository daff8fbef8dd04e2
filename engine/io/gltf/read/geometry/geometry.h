// Internal to io/gltf: converts primitives to triangle meshes.
#pragma once

#include "io/gltf/read/context.h"

#include <string>
#include <vector>

namespace blush {

// Vertex attributes to read besides positions, normals and colours.
struct VertexNeeds {
    std::vector<int> uv_sets; // ascending
    int tangent_uv_set = -1;  // UV set of the normal map, which needs tangents; -1: none
};

// Triangles of one primitive, with normals. Points and lines become small solids (points_lines.h). Null, with a diagnostic,
// if nothing remains.
// Triangles with a non-finite corner are skipped with a warning.
// Errors: an index or accessor out of range, arrays of different lengths, no finite triangle at all.
Result<GeometryPtr> import_primitive(const GltfContext& context, const tinygltf::Primitive& primitive, const VertexNeeds& needs,
                                     const std::string& where);

} // namespace blush
