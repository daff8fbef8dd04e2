// Pilot of smooth edges: finds the pixels in which more samples of the emission that the camera sees pay.
#pragma once

#include "core/parallel.h"
#include "render/error/small_highlights.h"
#include "render/film/edges/edge_pixels.h"
#include "render/kernels/kernel.h"
#include "render/pilots/edges/highlight_pilot.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace blush {

struct EdgesFound {
    EdgePixels pixels;
    SmallHighlights highlights;
};
struct EdgeKernels {
    const Kernel &paths, &emission;
};

// At an edge of an emitter a sample has the emission E with probability a, the coverage, or else the light R that the path finds
// beyond the edge. With M samples of the emission for each path (edge_samples.h) its variance is
//
//     a (1 - a) (E - R)^2   before,      a (1 - a) (R^2 + E^2 / M)   after.
//
// It falls only if E is more than 2 R / (1 - 1 / M): otherwise the light on both sides partly cancels, and separate samples do not. In
// general, with V the variance of the emission alone,
//
//     gain = V (1 - 1 / M - 2 R / E).
//
// A pixel is taken if its gain, as a share of the image's MSE plus as a share of its relMSE, exceeds twice its additional work as a
// share of the image's work: then MSE x relMSE x work^2 of the image falls.
//
// Three renders with a seed of their own find this out, so the result does not depend on the samples of the image: the emission of the
// whole film, one sample per pixel; and an image of a quarter of its width and height and its emission, two samples per pixel, for R,
// the noise and the work of paths. Edges take a larger share of that image, so their share of the noise is rather overestimated and
// fewer pixels are taken. Pixels whose neighbours differ enough in emission, by E, then take some samples each for V. Work is counted in
// rays, not in time: the result is the same for any number of threads and any instruction set.
//
// Highlights of lamps in mirrors and glass are edges, too, but hardly any sample of one per pixel meets them. Samples of the emission
// follow all chains of delta lobes (delta_chains.h), which also tell the variance of paths, that select one. Where highlight_location.h
// finds the places of highlights, they aim at these. Pixels with such places, and those near sightings of highlight_pilot.h without, are
// measured, at most one pixel in 64 and the nearest to a lamp first: by 32 samples of the emission each, and where these do not aim by 128
// in the 256 nearest and those at which one of the 32 met light like that of a sighting. A pixel beside others that met a highlight counts
// as if one more sample had. In the other pixels of a cell of sightings, these estimate both variances. highlight_samples.h chooses how
// many samples of the emission each takes. The coarse image meets hardly any highlight, so the noise of the image is here the sum of that
// of its light other than emission, that of the measured pixels, and that of highlights sighted beyond those that the measured samples met.
// With the mean of the emission, e, the gain of M samples of variance V_c each over the V of a path is
//
//     gain = V - V_c / M - 2 E[e] R.
//
// `highlights` of the result: those that the samples of the measured pixels met, and what was sighted beyond them by more than two standard
// errors.
//
// `context` as for the film at full resolution, except its seed and groups. `paths`: the kernel of samples; `emission`: one with all
// features that they need but light paths. `light_path_work`: rays (path_work) of light paths for one sample of a pixel. `longest_chain`: 0
// where smooth surfaces have no smooth edges; then `sightings` must be empty. `scratch`: one per worker, allocated if needed. Empty if
// `wanted` returned false.
std::optional<EdgesFound> find_edge_pixels(const KernelContext& context, const EdgeKernels& kernels, double light_path_work,
                                           int longest_chain, const Sightings& sightings, const Workers& workers,
                                           std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted);

} // namespace blush
