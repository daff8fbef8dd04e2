// Which triangles of a mesh lie on its convex hull. Such a triangle is not hidden by its mesh from any point in front of it.
#pragma once

#include "core/parallel.h"
#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace blush {

// By triangle: 1 if no vertex of the mesh is in front of its plane, by more than rounding. All triangles of a closed convex mesh, those of
// an outer shell without its inside, none of a bowl's inside. 0 without area, or if a vertex of the mesh is not finite. O(n log n) for
// convex meshes and for most others.
std::vector<uint8_t> hull_triangles(const Geometry& mesh, const Workers& workers);

} // namespace blush
