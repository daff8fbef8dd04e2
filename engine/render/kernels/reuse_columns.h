// What path reuse remembers of a tile (path_reuse.h).
#pragma once

#include "render/kernels/column.h"
#include "render/kernels/group_columns.h"

#include <cstdint>
#include <vector>

namespace blush {

// Vertices as a connection sees them: position and how far along ng a ray must start, normals, whether the vertex takes part at all.
struct JunctionColumns {
    Column<float> px, py, pz, clearance, gx, gy, gz, sx, sy, sz;
    Column<int32_t> takes_part;
};

// As many groups as fit into the queues at a time. Their members have seats, group by group, also those that are not there.
struct ReuseBatch {
    static constexpr int most_seats = tile_capacity / 4; // each may offer a vertex to its whole group
    int groups = 0, vertices = 0;
    Column<int32_t> slot;                             // by seat: in the tile, -1 if nobody takes part
    Column<float> reflects_r, reflects_g, reflects_b; // by seat: 1 or 0
    Column<float> sum_r, sum_g, sum_b;                // by seat: what its pixel gets, over its reflectance
    Column<int32_t> shared;                           // by seat: 1 if its vertex went to all, 0 if not
    Column<int32_t> place, own_seat;                  // by vertex: in the queue of bounce 1; of its own pixel
    Column<float> density, drawn;                     // by vertex and member: pi V G; and of what the member draws, aiming included
};

struct ReuseColumns {
    JunctionColumns first;              // by slot
    Column<float> rho_r, rho_g, rho_b;  // by slot: reflectance of the first vertex
    RadianceColumns own;                // by slot: radiance that is not shared
    std::vector<RadianceColumns> own_groups; // the same by group of lights; empty: nobody mixes
    Column<int32_t> second_of;          // by slot: place in the queue of bounce 1, -1: none
    JunctionColumns second;             // by place in that queue
    Column<uint32_t> random;            // likewise: for stochastic opacity
    ReuseBatch batch;
};

} // namespace blush
