// Path reuse gives pixels of a block errors in common: how much, as the halves of the film tell.
#pragma once

#include "render/reuse_groups.h"

namespace blush {

class Film;
class Workers;
struct ErrorEstimate;

// Ratios to what they would be if pixels erred independently; from 1 to the size of a group.
struct SharedErrors {
    double means = 1;    // of the variance of a mean over pixels
    double products = 1; // of the variance of the sum of products of the halves' errors, which the error estimate's interval is made of
};

// Partners are drawn anew for every sample, so all pairs of pixels of a block have about the same correlation r. With d for the half
// differences of n pixels, the square of their sum over the sum of their squares is 1 + n r, which is `means`; the products of the halves'
// errors, whose pairs have the correlation r^2, have 1 + n r^2. Blocks are those of `groups`, and the smaller ones of adaptive sampling
// within them (sample_plan.h), whose pairs may have more in common. Of a large film, in blocks spread over it.
SharedErrors measure_shared_errors(const Film& film, const ReuseGroups& groups);

// Of a film that was rendered with `reuse` pixels in a group.
ErrorEstimate estimate_error(const Film& film, int reuse, const Workers& workers);

} // namespace blush
