// Which pixels of the film share the second vertices of their paths (path_reuse.h).
#pragma once

#include <cstdint>

namespace blush {

// The film is cut into cells of 4 x 4 pixels. A group has one pixel of each of columns x rows cells, so that neighbours are in
// different groups and what the members of a group have in common does not show as blotches; which pixel is shuffled from cell to
// cell, lest it show as a pattern. Groups are fixed in the film, and a tile that begins and ends at multiples of `block` has them
// whole, but for the film's border.
struct ReuseGroups {
    static constexpr int cell = 4;     // pixels along a side
    static constexpr int largest = 16; // pixels in a group
    static constexpr int block = 16;   // pixels along a side of a square that no group reaches out of

    int columns = 1, rows = 1;

    constexpr int size() const { return columns * rows; }
    constexpr bool operator==(const ReuseGroups&) const = default;
};

// Of 4, 8 or 16 pixels; any other size is no group.
constexpr ReuseGroups reuse_groups(int size) {
    switch (size) {
    case 4: return {2, 2};
    case 8: return {4, 2};
    case 16: return {4, 4};
    default: return {};
    }
}

} // namespace blush
