// Tangent frames for meshes that have a normal map but no tangents.
#pragma once

#include "scene/scene.h"

namespace blush {

// One tangent per vertex from the directions in which `uv` grows, averaged over the triangles around the vertex and made
// perpendicular to its normal; w is the handedness. glTF asks for MikkTSpace, which differs where triangles of unlike UV
// orientation meet at a vertex. Vertices whose UVs say nothing get some perpendicular of the normal.
// Needs normals and uv of positions.size().
std::vector<Vec4> tangents_from_uv(const Geometry& geometry, const std::vector<Vec2>& uv);

} // namespace blush
