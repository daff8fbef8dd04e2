#include "render/clamp_ledger.h"

#include "core/math.h"

#include <algorithm>
#include <limits>

namespace blush {
namespace {

template <class Columns> Vec3d radiance_in(const Columns& columns, int slot) { return {columns.r[slot], columns.g[slot], columns.b[slot]}; }

} // namespace

void ClampLedger::reset(size_t places, const Clamp& clamp) {
    clamp_ = clamp;
    accounts_.assign(on() ? places : 0, {});
}

float ClampLedger::least_sum() const { return on() ? clamp_.limit : std::numeric_limits<float>::max(); }

ClampLedger::Left ClampLedger::clamp(size_t place, const TileScratch& tile, int slot) {
    const Vec3d whole = radiance_in(tile, slot);
    if (!on()) return {whole, 0, 1};
    Vec3d spared{0, 0, 0};
    if (!clamp_.all) spared = tile.bounces->recorded > 1 ? radiance_in(tile.bounces->after[1], slot) : whole;
    const Vec3d judged = whole - spared;
    const double most = std::max({judged.x, judged.y, judged.z});
    if (!(most > double(clamp_.limit))) return {whole, 0, 1};
    const double scale = double(clamp_.limit) / most;
    Account& account = accounts_[place];
    account.removed = account.removed + judged * (1 - scale);
    ++account.samples;
    return {spared + judged * scale, clamp_.all ? 0 : 2, scale};
}

} // namespace blush
