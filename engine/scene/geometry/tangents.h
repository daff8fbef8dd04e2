// Generates tangents for meshes without them whose materials need them.
#pragma once

#include "scene/scene.h"

namespace blush {

// UV set that a part's tangents follow, for normal maps and anisotropy; -1 if it needs none. From its material, or else from the
// first variant material that needs tangents, independent of the chosen variant.
int tangent_uv_set(const Scene& scene, const MeshPart& part);
// True if any material needs tangents.
bool any_needs_tangents(const Scene& scene);

// Adds MikkTSpace tangents computed from a UV set, which the geometry must have beside normals. A vertex whose triangles have
// different tangents, as at the seam of a mirrored texture, is split: copies are appended to the arrays and are deformed like it.
// The geometry must not have generated tangents already.
void add_tangents(Geometry& geometry, int uv_set);

// The geometry as it was before add_tangents; the same pointer if no tangents were generated.
GeometryPtr without_generated_tangents(const GeometryPtr& geometry);

} // namespace blush
