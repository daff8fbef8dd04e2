// Decides which large meshes get a compact BVH.
#pragma once

#include <cstddef>
#include <cstdint>

namespace blush {

// By default, BVH leaves store triangle vertices. If memory is short they store indices instead: this saves 27 bytes per
// triangle, 50 during the build, and rendering takes 1.24 times as long (closed room of a million triangles).

// Peak bytes per triangle while building a BVH with vertices: peak of the process for a mesh of a million triangles minus the
// peak for two hundred triangles, 164 bytes, minus 28 for the file data.
constexpr uint64_t bvh_bytes_per_triangle = 136;
// Fraction of the free memory that BVHs may use; the rest is for films, frames and later allocations.
constexpr double max_bvh_memory_share = 0.5;

constexpr bool needs_compact_bvh(size_t triangles, uint64_t memory_left) {
    return double(triangles) * double(bvh_bytes_per_triangle) > max_bvh_memory_share * double(memory_left);
}

} // namespace blush
