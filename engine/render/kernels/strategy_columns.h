// Radiance of a tile's paths by the strategy that has found it.
#pragma once

#include "render/film/found_by.h"
#include "render/kernels/group_columns.h"

#include <algorithm>
#include <vector>

namespace blush {

struct StrategyColumns {
    explicit StrategyColumns(bool keeps_direct) : light(path_strategies, keeps_direct), unshared(path_strategies) {}

    GroupColumns light;                    // by FoundBy, without light paths
    std::vector<RadianceColumns> unshared; // the same as ReuseColumns::unshared
    // By slot: share of path guiding in the density of the path's direction, from its last vertex that is not a delta lobe. guided[now]
    // is that of the rays of this bounce, the other one that of the next.
    Column<float> guided[2];
    int now = 0;

    void clear(int paths) {
        light.clear(paths);
        std::fill_n(guided[now].data, paths, 0.f);
    }
    // Light that the ray of the path has met: split by the share of path guiding.
    void add_hit(int slot, double r, double g, double b) {
        const double share = double(guided[now][slot]);
        light.add(int(FoundBy::camera_hit), slot, r - r * share, g - g * share, b - b * share);
        light.add(int(FoundBy::guided), slot, r * share, g * share, b * share);
    }
    void next_bounce() { now = 1 - now; }
};

} // namespace blush
