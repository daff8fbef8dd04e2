#include "measure/statistics/bounce_energy.h"

#include "core/math.h"
#include "render/film/found_by.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace blush {
namespace {

Vec3d mean_of(const std::vector<Vec3>& plane) {
    Vec3d sum{0, 0, 0};
    for (const Vec3& v : plane) sum = sum + Vec3d{double(v.x), double(v.y), double(v.z)};
    return sum / double(std::max<size_t>(1, plane.size()));
}

std::vector<PlaneEnergy> with_shares(std::vector<PlaneEnergy> energies) {
    double whole = 0;
    for (const PlaneEnergy& e : energies) whole += luminance(e.mean);
    if (whole > 0)
        for (PlaneEnergy& e : energies) e.share = luminance(e.mean) / whole;
    return energies;
}

} // namespace

std::vector<PlaneEnergy> bounce_energy(const Frame& frame) {
    std::vector<PlaneEnergy> energies;
    for (size_t k = 0; k < frame.bounces.size(); ++k) {
        const bool last = k + 1 == frame.bounces.size();
        energies.push_back({fmt::format("{}{}", k, last ? "+" : ""), mean_of(frame.bounces[k]), 0});
    }
    return with_shares(std::move(energies));
}

std::vector<PlaneEnergy> strategy_energy(const Frame& frame) {
    std::vector<PlaneEnergy> energies;
    for (size_t k = 0; k < frame.strategies.size(); ++k)
        energies.push_back({std::string(found_by_names[k]), mean_of(frame.strategies[k]), 0});
    return with_shares(std::move(energies));
}

} // namespace blush
