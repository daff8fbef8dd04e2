// Learns from bounce rays in which directions each region of the scene sees the environment.
#pragma once

#include "render/lights/escape_trial.h"
#include "shading/environment.h"
#include "shading/light.h"

#include <cstdint>
#include <span>
#include <vector>

namespace blush {

// The portals of a scene (shading/portals.h), from the bounce rays of a pilot.
//
// BSDF sampling finds an open sky well, and a window seldom. A cell gets a portal if few of its rays escape, but some do. Rays leave
// diffuse surfaces with a density in proportion to the cosine, so the number of rays that escape through a bin estimates the integral of
// cosine times visibility over the bin, averaged over the cell's receivers; times the mean radiance of the bin, its share of the
// irradiance. That is the probability of the bin, smoothed over its neighbours and drawn towards that of the 2x2x2 cells around where the
// cell has few such rays. One sample in ten is uniform over all directions (defensive mixture, Hesterberg 1995).
//
// The result does not depend on the order of the trials, and scales exactly with powers of two.
class LearnedPortals {
public:
    static constexpr int cells_along_longest = 8;
    static constexpr double uniform_share = 0.1;
    static constexpr double largest_escaping_share = 0.3;

    LearnedPortals() = default;
    // Trials of delta lobes count for the grid only. `alone`: light sampling has no lights.
    LearnedPortals(std::span<const EscapeTrial> trials, const EnvironmentTables& environment, bool alone);

    // Valid as long as this object. Without rows if no cell has a portal.
    PortalTables tables() const;
    // Share of the trials in cells with a portal.
    double reach() const { return reach_; }
    bool operator==(const LearnedPortals&) const = default;
    int64_t memory_bytes() const { return int64_t(rows_.capacity() * sizeof(int32_t) + bins_.capacity() * sizeof(PortalBin)); }

private:
    PortalTables shape_; // without pointers
    std::vector<int32_t> rows_;
    std::vector<PortalBin> bins_;
    double reach_ = 0;
};

} // namespace blush
