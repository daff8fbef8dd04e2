// How large meshes are traced.
#pragma once

#include <cstddef>
#include <cstdint>

namespace blush {

// Leaves of the ray tracer's trees hold the corners of their triangles. Where memory is short they hold indices alone: that saves 27 bytes a
// triangle, 50 while the tree is built, and a picture takes 1.24 times as long (a closed room of a million triangles).

// Bytes a triangle that building a tree with corners takes at most: the peak of the process with a mesh of a million triangles over that with two
// hundred, 164 bytes, without the 28 of the file's own.
constexpr uint64_t tree_bytes_per_triangle = 136;
// Of the memory that the process may still have; the rest is for films, frames and what else is made later.
constexpr double max_tree_share = 0.5;

constexpr bool needs_compact_tree(size_t triangles, uint64_t memory_left) {
    return double(triangles) * double(tree_bytes_per_triangle) > max_tree_share * double(memory_left);
}

} // namespace blush
