// More samples of the emission that the camera sees, directly or by delta lobes alone, in pixels at edges of emitters and with highlights.
#pragma once

#include "render/film/edges/edge_pixels.h"
#include "render/kernels/kernel.h"

#include <memory>

namespace blush {

// Per-worker memory.
struct EdgeScratch {
    TileScratch own, more;
};

// Replaces, in each sample of a tile in `pixels`, the emission at the end of a chain of delta lobes by the mean of M of its own, M being
// `pixels.samples()`:
//
//     radiance - e0 + (e1 + ... + eM) / M
//
// e0 is the emission that the sample's own path has found, so the mean stays the same: a render of emission alone (`emission_only`), of at
// most `pixels.longest_chain()` scatterings, with the seed and the index of the sample. The others follow all delta lobes
// (integrator/delta_chains.h), and aim at the places of highlights (highlight_places.h). They have a seed of their own, and those of all
// samples of a half of the film are one sequence of the sampler; so the halves stay independent, and a sample is the same in any range in
// which it is rendered.
//
// Its rays are not counted: the number of camera rays is that of paths.
//
// Light groups, light by bounces and what camera rays hit get the same difference as the radiance; first hits stay those of the sample's
// own ray. A sample stays as it is if one of its emission samples is negative or not finite.
//
// `context`: of the samples. `kernel`: with all features that they need but light paths.
void refine_emission(KernelContext context, const Kernel& kernel, const EdgePixels& pixels, const TileJob& job, TileScratch& tile,
                     EdgeScratch& scratch);

// Restricts `context` to emission at the end of at most `longest_chain` delta lobes. `tables`, which `context` then refers to, receives
// those of its scene without light paths and manifold sampling, which do not find this light.
void restrict_to_emission(KernelContext& context, SceneTables& tables, int longest_chain);

} // namespace blush
