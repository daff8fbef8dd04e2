// Radiance of a tile's paths by the number of scatterings.
#pragma once

#include "render/kernels/group_columns.h"

#include <vector>

namespace blush {

// after[k] holds light of at most k scatterings. Never longer than the film requires.
struct BounceColumns {
    explicit BounceColumns(int count) : after(size_t(count)), chained(size_t(count) + 1) {}

    std::vector<RadianceColumns> after;
    int recorded = 0; // number of valid columns; if all paths ended earlier, the others equal the final radiance
    // Light of manifold sampling by its own number of scatterings, the last one of all further ones. The path itself gets there later or
    // has been there before, so it is added at the end. Valid if has_chained.
    std::vector<RadianceColumns> chained;
    bool has_chained = false;

    void begin() {
        recorded = 0;
        has_chained = false;
    }
};

} // namespace blush
