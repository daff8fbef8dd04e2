#include "render/bounce_planes.h"

namespace blush {

void BouncePlanes::reset(size_t places, int planes) {
    planes_ = planes;
    sums_.assign(places * size_t(planes), Vec3d{0, 0, 0});
}

void BouncePlanes::add(size_t place, const TileScratch& tile, int slot) {
    const BounceColumns& columns = *tile.bounces;
    Vec3d* sums = &sums_[place * size_t(planes_)];
    Vec3d before{0, 0, 0};
    const auto add_difference = [&](Vec3d& sum, const auto& column) {
        const Vec3d now{column.r[slot], column.g[slot], column.b[slot]};
        sum = {sum.x + (now.x - before.x), sum.y + (now.y - before.y), sum.z + (now.z - before.z)};
        before = now;
    };
    for (int k = 0; k < columns.recorded; ++k) add_difference(sums[k], columns.after[size_t(k)]);
    add_difference(sums[columns.recorded], tile);
}

} // namespace blush
