// What a light meter reads: the irradiance of a point, estimated with the kernels' own stages, without a receiver in the scene.
#pragma once

#include "core/vec.h"
#include "core/sampler.h"
#include "render/kernels/kernel.h"
#include "render/path.h"

#include <cstdint>

namespace blush {

// A place that light falls on from the side of its normal.
struct MeterPoint {
    Vec3 position; // about the scene's origin (RenderScene::origin), off any surface
    Vec3 normal;   // unit length
};

// A shadow ray from the receiver to a point on a light, worth the radiance that a white matte surface there would send on, by the sampler's
// numbers for the first scattering of a path. `part`: of the scene that the receiver lies on, which lights may leave out; or from_meter (links.h).
Step<float> aim_at_light(const KernelContext& context, const MeterPoint& receiver, const Sampler<float>& sampler, int32_t part);

constexpr int most_irradiance_samples = 1024; // of one call

// Mean of `samples` estimates of the irradiance, RGB in lux: light samples and cosine-distributed rays, combined and followed as at a first
// matte surface of a path. `replicate` chooses the random numbers: replicates are independent, samples of one are stratified together.
// Light takes at most settings.max_bounces scatterings on its way, the one that a matte surface here would add included; one at least.
// To be called from within Workers::run or for_each.
Vec3d estimate_irradiance(KernelContext context, const MeterPoint& receiver, uint32_t replicate, int samples, TileScratch& scratch);

} // namespace blush
