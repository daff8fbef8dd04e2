// A column: one number per path of a tile.
#pragma once

namespace blush {

// Maximal number of paths in a tile. Enough to fill packets after most paths have ended, small enough for the L2 cache.
constexpr int tile_capacity = 4096;

// One number per path, padded so that whole registers can be read and written past the end.
template <class T> struct Column {
    alignas(64) T data[tile_capacity + 64];
    operator T*() { return data; }
    operator const T*() const { return data; }
};

} // namespace blush
