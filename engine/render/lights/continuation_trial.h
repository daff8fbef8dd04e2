// What the pilot of the adjoint records: the light and the work behind the vertices of paths.
#pragma once

#include "core/vec.h"
#include "render/lights/light_ahead.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace blush {

// A path that goes on from a rough surface.
struct ContinuationTrial {
    Vec3 position, normal;
    float radiance; // luminance that it finds behind this vertex for a throughput of luminance 1: nits
    float rays;     // that it takes from here, without shadow rays
};

// The trials of a tile's paths, accumulated.
struct ContinuationTrials {
    std::vector<ContinuationTrial> all;

    // Call at the begin of a tile with so many slots. Outside of the kernels, which call it: they must not hold a copy of std::vector's
    // functions (core/isa.h).
    void begin(int slots);
    void note_ray(int slot) { ++rays_[size_t(slot)]; }
    // `throughput`: luminance, behind the vertex. Call after the ray to the vertex has been noted.
    [[gnu::always_inline]] void add(const Vec3& position, const Vec3& normal, int slot, double throughput) {
        all.push_back({position, normal, float(1 / throughput), float(rays_[size_t(slot)])});
        ahead_.add(slot);
    }
    template <class Radiance> void note_arrived(const Radiance& radiance) { ahead_.note_arrived(radiance); }
    template <class Radiance> void finish(const Radiance& radiance) {
        const size_t first = all.size() - ahead_.size();
        ahead_.finish(radiance, [&](size_t k, int slot, double luminance) {
            ContinuationTrial& trial = all[first + k];
            trial.radiance = float(luminance * double(trial.radiance));
            trial.rays = float(rays_[size_t(slot)]) - trial.rays;
        });
    }

private:
    LightAhead ahead_;
    std::vector<int32_t> rays_; // by slot, so far
};

} // namespace blush
