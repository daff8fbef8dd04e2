// Meshes of lamps: convex and others, of any number of triangles.
#pragma once

#include "tests/render/scenes.h"

#include <cstdint>
#include <vector>

namespace blush::test {

// Inscribed in the unit sphere, axis Y.
GeometryPtr ball(uint32_t rows, uint32_t columns);
// Half of it, open at the bottom; `inward`: a bowl upside down.
GeometryPtr hemisphere(uint32_t rows, uint32_t columns, bool inward);
// A ball whose halves are moved apart by a tube of length 2 `half`, axis Y.
GeometryPtr capsule(uint32_t rows, uint32_t columns, float half);
// Around axis Y.
GeometryPtr torus(uint32_t around, uint32_t across, float radius, float tube);
// [-1, 1]^3 of n x n squares a face, without common vertices.
GeometryPtr grid_cube(int n);
// [-1, 1]^2 at y = 0, facing up.
GeometryPtr grid_quad(int n);

GeometryPtr moved(const GeometryPtr& mesh, const Vec3& by);
GeometryPtr joined(const std::vector<GeometryPtr>& meshes);

} // namespace blush::test
