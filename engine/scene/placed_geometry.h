// Large shapes whose arrays lie where kernels read them (core/numbered_arrays.h): they are held in memory once.
#pragma once

#include "scene/scene.h"

#include <optional>

namespace blush {

// Fewer vertices are cheap to copy, and a range of numbers for each shape would be waste.
constexpr size_t fewest_placed_vertices = size_t(1) << 14;

// Moves the arrays of a large shape there, one after the other; the last thing that is done to it before it is shared. Small ones, and all if there
// are no numbers left, stay as they are.
void place_arrays(Geometry& geometry);

// The number of the shape's first vertex in all of its arrays and of its first index.
struct PlacedAt {
    int32_t first_vertex = 0, first_index = 0;
};
// None if any of its arrays lies elsewhere: of a small one, or a copy.
std::optional<PlacedAt> placed_at(const Geometry& geometry);

} // namespace blush
