// The tangent space of normal maps, MikkTSpace (M. S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008), with the
// default angular threshold of 180 degrees: all triangles are averaged except those with opposite directions.
#pragma once

#include "scene/scene.h"

namespace blush {

// One tangent per corner of each triangle, perpendicular to the corner's normal; w is the handedness as in glTF: the bitangent
// cross(normal, tangent) * w points up in the image, where v is smaller.
// Corners with equal position, normal and texture coordinates are one vertex. At a vertex, triangles that are connected by edges
// and have the same UV orientation share a tangent: the mean direction of increasing u, weighted by the triangles' angles at the
// vertex. Corners with degenerate UVs get an arbitrary perpendicular of the normal.
// `geometry` has unit normals and valid indices, `uv` one element per position.
std::vector<Vec4> mikktspace_tangents(const Geometry& geometry, const GeometryArray<Vec2>& uv);

} // namespace blush
