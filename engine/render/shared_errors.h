// Path reuse gives the pixels of a group errors in common: how much, as the halves of the film tell.
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

// With d for the half differences of the pixels of a group: the square of their sum over the sum of their squares; and the same for the
// products d d' with those of the group beside it, whose pixels lie in the same cells but share nothing with it. Of a large film, in blocks
// spread over it.
SharedErrors measure_shared_errors(const Film& film, const ReuseGroups& groups);

// Of a film that was rendered with `reuse` pixels in a group.
ErrorEstimate estimate_error(const Film& film, int reuse, const Workers& workers);

} // namespace blush
