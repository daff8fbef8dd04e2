#include "render/film/bounce_planes.h"

#include "core/math.h"

#include <algorithm>

namespace blush {

void BouncePlanes::reset(size_t places, int planes) {
    planes_ = planes;
    sums_.assign(places * size_t(planes), {});
}

void BouncePlanes::add(size_t place, const TileScratch& tile, int slot, int first_scaled, double scale) {
    const BounceColumns& columns = *tile.bounces;
    ExactSum3* sums = &sums_[place * size_t(planes_)];
    Vec3d before{0, 0, 0};
    const auto add_difference = [&](int k, const auto& column) {
        const Vec3d now{column.r[slot], column.g[slot], column.b[slot]};
        sums[k].add((now - before) * (k < first_scaled ? 1 : scale));
        before = now;
    };
    // Clamping may need more columns than there are planes.
    const int noted = std::min(columns.recorded, planes_ - 1);
    for (int k = 0; k < noted; ++k) add_difference(k, columns.after[size_t(k)]);
    add_difference(noted, tile);
}

} // namespace blush
