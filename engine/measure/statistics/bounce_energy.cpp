#include "measure/statistics/bounce_energy.h"

#include "core/math.h"

#include <algorithm>
#include <fmt/format.h>

namespace blush {
namespace {

Vec3d mean_of(const std::vector<Vec3>& plane) {
    Vec3d sum{0, 0, 0};
    for (const Vec3& v : plane) sum = sum + Vec3d{double(v.x), double(v.y), double(v.z)};
    return sum / double(std::max<size_t>(1, plane.size()));
}

} // namespace

std::vector<BounceEnergy> bounce_energy(const Frame& frame) {
    std::vector<BounceEnergy> energies;
    double whole = 0;
    for (size_t k = 0; k < frame.bounces.size(); ++k) {
        const bool last = k + 1 == frame.bounces.size();
        energies.push_back({fmt::format("{}{}", k, last ? "+" : ""), mean_of(frame.bounces[k]), 0});
        whole += luminance(energies.back().mean);
    }
    if (whole > 0)
        for (BounceEnergy& e : energies) e.share = luminance(e.mean) / whole;
    return energies;
}

} // namespace blush
