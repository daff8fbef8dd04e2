// Size of the tiles that one worker renders at once.
#pragma once

#include "render/film/sample_allocation.h"
#include "render/integrator/reuse_groups.h"

#include <cstdint>

namespace blush {

// About two thousand paths per tile: enough to fill packets, few enough for the cache. Fewer for a small film, as during a drag,
// because all workers wait for the last tile.
struct TileShape {
    int width, height, samples;
};
inline TileShape tile_shape(int64_t count, int64_t pixels_per_worker) {
    if (count == 1 && pixels_per_worker < 16 * 2048) return {32, 16, 1};
    if (count >= 8) return {16, 16, 8};
    if (count >= 4) return {32, 16, 4};
    if (count >= 2) return {32, 32, 2};
    return {64, 32, 1};
}

// Where paths split, with room for the copies.
inline TileShape splitting_shape(int64_t count) { return count >= 2 ? TileShape{16, 16, 2} : TileShape{32, 16, 1}; }

// With path reuse a tile is a block, so that no group is cut.
inline TileShape tile_shape(const ReuseGroups& groups) { return {groups.block_width, groups.block_height, 1}; }
// Tiles of a sample plan have different numbers of samples, so groups must not cross tiles.
inline ReuseGroups reuse_groups_of_plan(int size) { return reuse_groups(size, SampleAllocation::tile_size, SampleAllocation::tile_size); }

} // namespace blush
