#include "render/film/clamp_stats.h"

#include "core/math.h"

#include <algorithm>
#include <limits>

namespace blush {
namespace {

template <class Columns> Vec3d radiance_in(const Columns& columns, int slot) { return {columns.r[slot], columns.g[slot], columns.b[slot]}; }

} // namespace

void ClampStats::reset(size_t places, const Clamp& clamp) {
    clamp_ = clamp;
    accounts_.assign(on() ? places : 0, {});
}

float ClampStats::min_clamped_sum() const { return on() ? clamp_.limit : std::numeric_limits<float>::max(); }

ClampStats::ClampResult ClampStats::clamp(size_t place, const TileScratch& tile, int slot) {
    const Vec3d whole = radiance_in(tile, slot);
    if (!on()) return {whole, 0, 1};
    Vec3d unclamped{0, 0, 0};
    if (!clamp_.all) unclamped = tile.bounces->recorded > 1 ? radiance_in(tile.bounces->after[1], slot) : whole;
    const Vec3d clampable = whole - unclamped;
    const double largest = std::max({clampable.x, clampable.y, clampable.z});
    if (!(largest > double(clamp_.limit))) return {whole, 0, 1};
    const double scale = double(clamp_.limit) / largest;
    ClampedSums& account = accounts_[place];
    account.removed.add(clampable * (1 - scale));
    ++account.samples;
    return {unclamped + clampable * scale, clamp_.all ? 0 : 2, scale};
}

} // namespace blush
