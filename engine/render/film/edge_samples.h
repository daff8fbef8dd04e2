// More camera rays for the emission that is seen directly, in pixels at edges of emitters.
#pragma once

#include "render/film/edge_pixels.h"
#include "render/kernels/kernel.h"

#include <memory>

namespace blush {

// Emission samples per sample of a pixel at an edge.
constexpr int edge_samples = 16;

// Per-worker memory.
struct EdgeScratch {
    TileScratch own, more;
};

// Replaces, in each sample of a tile in `pixels`, the emission at the first hit by the mean of `edge_samples` of its own:
//
//     radiance - e0 + (e1 + ... + eM) / M
//
// e0 is the emission that the sample's own camera ray has found, so the mean stays the same. All of them are renders without
// scattering. e0 has the seed and the index of the sample. The others have a seed of their own, and those of all samples of a half of
// the film are one sequence of the sampler; so the halves stay independent, and a sample is the same in any range in which it is
// rendered.
//
// Its rays are not counted: the number of camera rays is that of paths.
//
// Light groups, light by bounces and what camera rays hit get the same difference as the radiance; first hits stay those of the sample's
// own ray. A sample stays as it is if one of its emission samples is negative or not finite.
void refine_emission(KernelContext context, const Kernel& kernel, const EdgePixels& pixels, const TileJob& job, TileScratch& tile,
                     EdgeScratch& scratch);

} // namespace blush
