// Internal to gltf_*.cpp: primitives to triangles.
#pragma once

#include "io/gltf_source.h"

#include <string>

namespace blush {

// Triangles of one primitive, with normals; of points and lines, those of small solids (gltf_points_lines.h). Null, with a finding in the
// report, if it has none to show. `tangent_uv_set`: 0 or 1 if the material has a normal map on that UV set, so that tangents are needed; else -1.
// Triangles with a non-finite corner are left out with a warning.
// Errors: an index or accessor out of range, arrays of unlike length, no finite triangle at all.
Result<GeometryPtr> import_primitive(const GltfContext& context, const tinygltf::Primitive& primitive, int tangent_uv_set,
                                     const std::string& where);

} // namespace blush
