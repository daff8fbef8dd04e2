// Per-tile memory of path reuse (path_reuse.h).
#pragma once

#include "render/kernels/column.h"
#include "render/kernels/group_columns.h"

#include <cstdint>
#include <vector>

namespace blush {

// Vertices as connection end points: position, offset along ng for a ray's origin, normals, whether the vertex takes part.
struct ReuseVertexColumns {
    Column<float> px, py, pz, clearance, gx, gy, gz, sx, sy, sz;
    Column<int32_t> takes_part;
};

// Groups are processed in batches that fit the queues. Members have seats, group by group, including missing ones.
struct ReuseBatch {
    static constexpr int max_seats = tile_capacity / 4; // each seat may share a vertex with its whole group
    int groups = 0, vertices = 0;
    Column<int32_t> slot;                             // by seat: slot in the tile, -1 if empty
    Column<float> reflects_r, reflects_g, reflects_b; // by seat: 1 or 0
    Column<float> sum_r, sum_g, sum_b;                // by seat: sum for its pixel, divided by its reflectance
    Column<int32_t> shared;                           // by seat: 1 if its vertex is shared, else 0
    Column<int32_t> place, own_seat;                  // by vertex: position in the queue of bounce 1; seat of its own pixel
    // by vertex and member: pi V G; and the member's sampling density including caustic guiding
    Column<float> density, drawn;
};

struct ReuseColumns {
    ReuseVertexColumns first;                     // by slot
    Column<float> rho_r, rho_g, rho_b;            // by slot: reflectance of the first vertex
    RadianceColumns unshared;                     // by slot: unshared radiance
    std::vector<RadianceColumns> unshared_groups; // the same by light group; empty: no light mix
    Column<int32_t> second_of;                    // by slot: position in the queue of bounce 1, -1: none
    ReuseVertexColumns second;                    // by position in that queue
    ReuseBatch batch;

    // Sizes unshared_groups. Outside of the kernels: they must not hold a copy of std::vector's functions (core/isa.h).
    void hold_groups(size_t count);
};

} // namespace blush
