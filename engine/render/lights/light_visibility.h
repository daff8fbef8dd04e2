// Learns from shadow rays which lights each region of the scene sees.
#pragma once

#include "render/lights/shadow_trial.h"
#include "shading/light.h"

#include <cstdint>
#include <span>
#include <vector>

namespace blush {

// Factors on the importances of the light tree's root (shading/light_visibility.h), from the trials of a pilot.
//
// One sample that selects light k with probability p_k and estimates e_k V_k / p_k, where e_k is the importance and V_k is 1 with
// probability v_k and else 0, has the least variance with p_k proportional to e_k sqrt(v_k). So the factor is sqrt(v_k). A light that no
// trial saw may still reach some point of the cell: unlearned_share of the samples take no account of the factors.
//
// v_k is estimated by the share of arrived rays. Where a cell has few trials, its estimate is drawn towards that of the cell over all
// sides, of the 4x4x4 cells around, and of the whole scene. The grid covers the receivers of the trials, but for the outermost in each
// direction, with cubic cells. The result does not depend on the order of the trials, and scales exactly with powers of two.
class LightVisibility {
public:
    static constexpr int cells_along_longest = 16;

    LightVisibility() = default;
    // `lights` with a light tree. Trials with non-finite positions are ignored.
    LightVisibility(std::span<const ShadowTrial> trials, const LightTables& lights);

    // For LightTree::visibility; valid as long as this object. Without factors if there was nothing to learn.
    LightVisibilityGrid grid() const;
    // Estimated second moment of the selected light's contribution over that without the factors: geometric mean over the trials where
    // some light arrives. 1 at most.
    double second_moment() const { return second_moment_; }
    bool operator==(const LightVisibility&) const = default;
    int64_t memory_bytes() const { return int64_t(factors_.capacity() * sizeof(uint32_t)); }

private:
    LightVisibilityGrid shape_; // without factors
    std::vector<uint32_t> factors_;
    double second_moment_ = 1;
};

} // namespace blush
