// What the pilot of path guiding records: where photons arrive, and what paths find.
#pragma once

#include "core/vec.h"
#include "render/lights/light_ahead.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace blush {

// A photon on a diffuse surface, or a direction that a path sampled there.
struct GuidingTrial {
    Vec3 position, normal, direction; // direction: away from the surface, unit; normal: zero if light is received from both sides
    float value;                      // photon: flux, luminance; path: irradiance that it estimates, luminance
};

// A photon as it leaves a light.
struct EmittedPhoton {
    Vec3 origin{0, 0, 0}, direction{0, 0, 1};
    float flux = 0;     // luminance: nits m2 sr
    int32_t light = -1; // record
};

// A photon on a rough surface that it has reached from its light by delta lobes alone.
struct ChainPhoton {
    Vec3 position, normal, target; // target: point of its last surface before
    int32_t chain, light;          // events from here to the light (shading/manifold_seeds.h), record
    float flux;
};

// Where the photons of a scene arrived after smooth surfaces. Their flux is `emitted` times that of the caustics.
struct CausticPhotons {
    std::vector<GuidingTrial> arrived;
    std::vector<ChainPhoton> chains;
    int64_t emitted = 0;
};

// The photons of a tile: the kernel traces them instead of camera rays, and records where they arrive after smooth surfaces.
struct PhotonTrials {
    std::vector<EmittedPhoton> emitted; // by slot
    std::vector<GuidingTrial> arrived;
    std::vector<ChainPhoton> chains;
    std::vector<int32_t> events; // by slot, at first 0: those so far, the last first; -1: not all of them are of delta lobes
};

// The trials of a tile's paths, accumulated.
struct GuidingTrials {
    std::vector<GuidingTrial> all;

    // `factor`: cosine over pdf of the direction and luminance of the throughput behind the vertex: what radiance is multiplied by.
    [[gnu::always_inline]] void add(const GuidingTrial& trial, int slot, double factor) {
        all.push_back(trial);
        factors_.push_back(factor);
        ahead_.add(slot);
    }
    template <class Radiance> void note_arrived(const Radiance& radiance) { ahead_.note_arrived(radiance); }
    template <class Radiance> void finish(const Radiance& radiance) {
        const size_t first = all.size() - ahead_.size();
        ahead_.finish(radiance, [&](size_t k, int, double luminance) { all[first + k].value = float(luminance * factors_[k]); });
        factors_.clear();
    }

private:
    LightAhead ahead_;
    std::vector<double> factors_;
};

} // namespace blush
