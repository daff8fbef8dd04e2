#include "render/film/group_planes.h"

#include "core/math.h"

namespace blush {
namespace {

Vec3d radiance_in(const RadianceColumns& c, int slot) { return {c.r[slot], c.g[slot], c.b[slot]}; }

} // namespace

void GroupPlanes::reset(size_t pixels, int groups) {
    groups_ = groups;
    sums_.assign(2 * pixels * size_t(groups), {});
}

void GroupPlanes::add(size_t pixel, int half, const GroupColumns& columns, int slot, int first_scaled, double scale, int first_indirect) {
    ExactSum3* sums = &sums_[place(pixel, half)];
    for (size_t k = 0; k < size_t(groups_); ++k) {
        const Vec3d whole = radiance_in(columns.all[k], slot);
        if (scale == 1) {
            sums[k].add(whole);
            continue;
        }
        Vec3d unclamped{0, 0, 0};
        if (first_scaled > 0 && int(k) < first_indirect) unclamped = columns.has_direct ? radiance_in(columns.direct[k], slot) : whole;
        sums[k].add(unclamped + (whole - unclamped) * scale);
    }
}

} // namespace blush
