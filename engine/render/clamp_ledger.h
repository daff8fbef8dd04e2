// Clamping of samples, and an exact account of the light it takes away.
#pragma once

#include "core/vec.h"
#include "render/health.h"
#include "render/kernels/kernel.h"
#include "scene/render_settings.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace blush {

// A sample limited to `limit` in its largest component, hue kept: of all its light, or of what was scattered more than once.
class ClampLedger {
public:
    // An account for each place, one or two for each pixel.
    void reset(size_t places, const Clamp& clamp);
    bool on() const { return clamp_.limit > 0; }
    // Columns that the kernels must fill for that.
    int columns() const { return on() && !clamp_.all ? 2 : 0; }
    // No sample whose components sum to less than this is touched.
    float least_sum() const;

    // What is left of the sound sample in a tile's slot. `first_scaled` and `scale`: light of so many scatterings and more was multiplied
    // by that.
    struct Left {
        Vec3d radiance{0, 0, 0};
        int first_scaled = 0;
        double scale = 1;
    };
    // Notes the rest in the place's account.
    Left clamp(size_t place, const TileScratch& tile, int slot);

    // Light taken from a place, and the number of samples that it was taken from. Only while on.
    struct Account {
        Vec3d removed{0, 0, 0};
        int64_t samples = 0;
    };
    Account& account(size_t place) { return accounts_[place]; }
    const Account& account(size_t place) const { return accounts_[place]; }

private:
    Clamp clamp_;
    std::vector<Account> accounts_; // empty while off
};

} // namespace blush
