// Covariance between pixels caused by path reuse, by the sampler and by integrators for comparison, measured from the halves of the film.
#pragma once

#include "render/integrator/reuse_groups.h"

namespace blush {

class EdgePixels;
class Film;
class Workers;
struct ErrorEstimate;

// Ratios relative to independent pixels; from 1 to the group size.
struct ReuseCovariance {
    double means = 1; // of the variance of a mean over pixels
    // of the variance of the sum of products of the halves' errors, which gives the error estimate's interval
    double products = 1;
};

// Partners change with every sample, so all pairs of pixels of a block have about the same correlation r. With d for the half
// differences of n pixels, the square of their sum over the sum of their squares is 1 + n r, which is `means`; the products of
// the halves' errors, whose pairs have the correlation r^2, have 1 + n r^2. Blocks are those of `groups`, and the smaller tiles
// of adaptive sampling within them (sample_allocation.h), whose correlation may be higher. Large films are subsampled in blocks.
ReuseCovariance measure_reuse_covariance(const Film& film, const ReuseGroups& groups);

// Without path reuse: of the blocks of pixels with complementary points (core/sampler.h). Their errors mostly cancel, and count as
// independent then. What only two or more pairs of dimensions together explain may add up instead, by up to a half.
ReuseCovariance measure_sampler_covariance(const Film& film);

// Of integrators for comparison whose pixels share photons or states of a Markov chain, at any distance: the largest of
// blocks of 8 x 8 pixels, 16 x 16 and so on, as long as there are enough of them to tell.
ReuseCovariance measure_block_covariance(const Film& film);

// For a film rendered with `reuse` pixels per group. `edges`: as for Film::estimate_error.
ErrorEstimate estimate_error(const Film& film, int reuse, const Workers& workers, const EdgePixels* edges = nullptr);

} // namespace blush
