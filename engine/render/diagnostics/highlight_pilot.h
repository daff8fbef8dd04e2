// Pilot of small highlights: what camera samples rarely meet.
#pragma once

#include "core/parallel.h"
#include "render/error/small_highlights.h"
#include "render/kernels/kernel.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace blush {

// A lamp that a path of this pixel nearly met: light of this luminance, and its share of the rate and the mean of the image. `apart`: by 1
// - the cosine of the angle between the path and the lamp.
struct Sighting {
    int x, y;
    float apart;
    double luminance;
    SmallHighlights::Band band;
};
// `spacing`: of the paths that looked for them, in pixels.
struct Sightings {
    std::vector<Sighting> all;
    double spacing = 0;
};

// Camera paths are followed while only smooth surfaces turn them. At each of their vertices a point on a light is sampled. If it lies
// within a cone of 15 degrees around the next ray, and is not occluded, it stands for the light in that cone: with throughput beta,
// radiance L and pdf p it adds beta L / (p w) to the mean radiance and 1 / (p w) to the rate, w being the solid angle of the cone. This
// is a kernel density estimate (Silverman 1986): a cone some hundred times as large as a lamp is met as much more often.
//
// One path in each of at most 16,384 squares of pixels finds the smooth surfaces; squares where it meets one and those beside them get more
// paths. They have a seed of their own, so the result does not depend on the samples of the image, on the number of threads or on the
// instruction set. `context` as for the film at full resolution, except its seed and groups. `scratch`: one per worker, allocated if
// needed. Empty if `wanted` returned false.
std::optional<Sightings> find_small_highlights(const KernelContext& context, const Workers& workers,
                                               std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted);

// All of them, in ordinary pixels.
SmallHighlights highlights_of(const Sightings& sightings);

} // namespace blush
