// The irradiance at a point, as a light meter reads it, estimated with the kernels' own stages, without a receiver in the scene.
#pragma once

#include "core/sampler.h"
#include "core/vec.h"
#include "render/integrator/path.h"
#include "render/kernels/kernel.h"

#include <cstdint>
#include <vector>

namespace blush {

// A receiver lit from the side of its normal.
struct MeterPoint {
    Vec3 position; // relative to the scene's origin (RenderScene::origin), off any surface
    Vec3 normal;   // unit length
};

// NEE at the receiver: a shadow ray to a sampled point on a light, with the radiance that a white diffuse surface there would
// reflect, using the sampler dimensions of the first scattering. `part`: the part that the receiver is on, which light linking
// may exclude; or from_meter (links.h).
Step<float> sample_light_at_meter(const KernelContext& context, const MeterPoint& receiver, const Sampler<float>& sampler, int32_t part);

constexpr int max_irradiance_samples = 1024; // per call

// Puts `samples` paths, cosine-distributed around the normal, into scratch.paths[0], with slots from 0 on, and the shadow rays of NEE at
// the receiver into scratch.shadows. Connect these at bounce 0; the paths go on with bounce 1. Light that they find times pi is
// irradiance. `replicate` selects the random numbers.
void begin_paths_at_meter(const KernelContext& context, const MeterPoint& receiver, uint32_t replicate, int samples, TileScratch& scratch);

// Mean of `samples` estimates of the irradiance, RGB in lux: NEE and cosine-distributed rays combined by MIS, as at the first
// diffuse vertex of a path. `replicate` selects the random numbers: replicates are independent, samples of one are stratified
// together. Light takes at most settings.max_bounces scatterings including the one of a diffuse surface here; at least one. Call
// it from within Workers::run or for_each.
Vec3d estimate_irradiance(KernelContext context, const MeterPoint& receiver, uint32_t replicate, int samples, TileScratch& scratch);

// Paths from a point: their directions, and an estimate of the indirect radiance along each.
struct GatheredRays {
    std::vector<Vec3> direction; // unit, cosine-distributed about the receiver's normal
    std::vector<Vec3d> radiance; // without emission that the ray itself finds, in nits
    std::vector<float> distance; // to the first surface in metres; infinite if there is none
    // pi times the mean radiance, in lux.
    Vec3d irradiance() const;
};
// At most max_irradiance_samples paths, as those of estimate_irradiance() but without light that reaches the receiver directly.
GatheredRays gather_indirect(KernelContext context, const MeterPoint& receiver, uint32_t replicate, int samples, TileScratch& scratch);

} // namespace blush
