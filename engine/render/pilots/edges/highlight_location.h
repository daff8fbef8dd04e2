// Where the film shows lamps in smooth surfaces: from chains that nearly met a lamp to the places of its images.
#pragma once

#include "core/parallel.h"
#include "render/film/edges/highlight_places.h"
#include "render/kernels/kernel.h"
#include "render/pilots/edges/highlight_pilot.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace blush {

struct HighlightsLocated {
    std::vector<HighlightPlace> places;
    std::vector<bool> by_sighting; // true: the image of its lamp is among them
};

// Newton's method: the unknown is the position on the film, and the chain of a sighting is followed from there, by the same lobes, until it
// leads to the middle of the lamp (after Hanika, Droske and Fascione 2015, "Manifold Next Event Estimation"; here the receiver is the
// camera). Derivatives are differences of three chains side by side, so that all surfaces count as the renderer shades them. They also
// give the image of the lamp: of a sphere or a sun its disk, of a triangle the parallelogram of its edges.
//
// Images of more than half a pixel are left out: samples of the pixel meet them often enough. So are all where the camera has an aperture,
// which blurs them. A place may be wrong, where the chain is blocked behind it or the surface bends within the image: it is where samples
// aim, and no more (HighlightPlaces).
//
// `context`: of the chains, as restrict_to_emission() leaves it. `sightings`: nearest to a lamp first; of each lamp and each sequence of
// lobes only the nearest in a square of `spacing` pixels is followed, and at most 2,048 in all. `kernel`: with all features that the scene
// needs. `scratch`: one per worker, allocated. Empty if `wanted` returned false.
std::optional<HighlightsLocated> locate_highlights(const KernelContext& context, const Kernel& kernel, std::span<const Sighting> sightings,
                                                   double spacing, const Workers& workers,
                                                   std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted);

} // namespace blush
