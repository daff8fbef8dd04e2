// Pilot of small highlights: what camera samples rarely meet.
#pragma once

#include "core/parallel.h"
#include "render/error/small_highlights.h"
#include "render/kernels/kernel.h"
#include "scene/image_region.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace blush {

// A lamp that a delta chain of this pixel nearly met: light of this luminance for a path, which follows one lobe at each surface, and its
// share of the rate and the mean of the image. Chains meet 1 / `share` times as many, each with `share` times the light. `apart`: by 1 -
// the cosine of the angle between the chain and the lamp.
struct Sighting {
    int x, y;
    float apart;
    double luminance;
    SmallHighlights::Band band;
    double share;
    size_t cell; // of Sightings::cells
    ChainStart sample;
    ChainSighting chain;
};
struct Sightings {
    std::vector<Sighting> all;
    double spacing = 0;           // of the samples that looked for them, in pixels
    double rays = 0;              // of the chains of a sample
    int side = 1;                 // of a whole cell, in pixels
    std::vector<PixelRect> cells; // where samples looked for them, row by row
};

// Follows all chains of delta lobes from the camera (delta_chains.h). At each of their vertices a point on a light is sampled; if it lies
// within a cone of 15 degrees around the next ray, and is not occluded, it stands for the light in that cone (sight_lamps).
//
// One sample in each of at most 16,384 squares of pixels finds the smooth surfaces; squares where it meets one and those beside them get
// more. They have a seed of their own, so the result does not depend on the samples of the image, on the number of threads or on the
// instruction set. `context` as for the film at full resolution, except its seed and groups. `kernel`: with all features that the scene
// needs. `scratch`: one per worker, allocated if needed. Empty if `wanted` returned false.
std::optional<Sightings> find_small_highlights(const KernelContext& context, const Kernel& kernel, const Workers& workers,
                                               std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted);

// Those of light that camera samples meet in at most `most` pixels, nearest lamps first. Light that is seen in more has no small
// highlights: an environment in glass. `pixels`: of the image.
std::vector<Sighting> small_highlights(const Sightings& sightings, double most, double pixels);

// All of them, as paths meet them.
SmallHighlights highlights_of(const Sightings& sightings);

} // namespace blush
