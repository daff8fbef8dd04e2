// Tangent frames as the makers of normal maps compute them: MikkTSpace (M. S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008),
// with the default angular threshold of 180 degrees: all triangles but those that lie exactly opposite mix.
#pragma once

#include "scene/scene.h"

namespace blush {

// One tangent per corner of each triangle, perpendicular to the corner's normal; w is the handedness as glTF has it: the bitangent
// cross(normal, tangent) * w points up in the image, where v is smaller.
// Corners alike in position, normal and texture coordinates are one vertex. Around it, triangles that are joined by edges and whose texture is
// equally mirrored or not share a tangent: the mean of where u grows, weighted by the triangles' angles at the vertex. Corners whose UVs
// say nothing get some perpendicular of the normal.
// `geometry` has unit normals and valid indices, `uv` one element per position.
std::vector<Vec4> mikktspace_tangents(const Geometry& geometry, const PlacedVector<Vec2>& uv);

} // namespace blush
