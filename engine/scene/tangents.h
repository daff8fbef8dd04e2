// Tangent frames for meshes whose materials need them and that have none.
#pragma once

#include "scene/scene.h"

namespace blush {

// By which of its UV sets a part's normal maps and stretched reflections are laid out, -1: it has none. Its material says so, or else the
// first that a variant puts in its place, whichever is chosen.
int tangent_uv_set(const Scene& scene, const MeshPart& part);
// Some material needs tangents.
bool any_needs_tangents(const Scene& scene);

// Gives the geometry the tangents that MikkTSpace computes from one of its UV sets, which it must have beside normals. A vertex whose
// triangles do not agree, as where the halves of a mirrored texture meet, becomes several: copies are added behind all others, and bend as
// it does. Those that it has must not be made ones.
void add_tangents(Geometry& geometry, int uv_set);

// As it was before add_tangents; itself if none were made.
GeometryPtr without_made_tangents(const GeometryPtr& geometry);

} // namespace blush
