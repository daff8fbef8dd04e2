// Stores large meshes in the geometry arena (core/geometry_arena.h), where kernels read them without a copy.
#pragma once

#include "core/geometry_arena.h"
#include "scene/scene.h"

#include <optional>

namespace blush {

// Smaller meshes are copied when the scene is compiled: cheap, and saves arena ranges.
constexpr size_t min_arena_vertices = size_t(1) << 14;

// Reserves room in the arena for a large mesh of so many vertices and indices, whose arrays are then made by unset_array() and
// filled where they stay. None for small meshes or if the arena is full.
std::shared_ptr<const void> reserve_in_arena(size_t vertices, size_t indices);

// An array of `count` unset elements for this attribute of a mesh with this Geometry::storage: in its room if it has some for so
// many, else on the heap, with the padding behind it that Embree needs.
template <class T> GeometryArray<T> unset_array(const std::shared_ptr<const void>& storage, Attribute attribute, size_t count);
GeometryArray<uint32_t> unset_indices(const std::shared_ptr<const void>& storage, size_t count);

// Moves the arrays of a large mesh into the arena, unless they are there. Call it last, before the mesh is shared. Does nothing for
// small meshes or if the arena is full.
void move_to_arena(Geometry& geometry);

// Copies vertices, their attributes and indices into a new geometry, large ones straight into the arena.
void copy_arrays(const Geometry& from, Geometry& to);

// Arena offsets, in elements: of the first vertex (the same in all vertex arrays) and of the first index.
struct ArenaOffsets {
    int32_t first_vertex = 0, first_index = 0;
};
// None if any of the arrays is not in the arena: of a small mesh, or a copy.
std::optional<ArenaOffsets> arena_offsets(const Geometry& geometry);

} // namespace blush
