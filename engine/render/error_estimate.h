// The error of an image without a reference: from the difference of two independent randomisations of the sampler.
#pragma once

#include "render/error_sums.h"
#include "render/frame.h"

namespace blush {

// Of the mean of two half images A, B, each an unbiased estimate of the same picture, with 95 % intervals.
//
// With a and b for their errors, the picture (A + B) / 2 has the squared error (a + b)^2 / 4 and the half difference d = (A - B) / 2 has
// the square (a - b)^2 / 4. They differ by ab, whose mean is 0 because the halves are independent, whatever correlations a sampler has
// within a half: honest for low-discrepancy points, for which the sample variance is not. So the sum of squared half differences estimates
// the squared error of this very picture, not of one like it: a firefly is in both alike.
//
// What is left over is the sum of ab, of variance var(a) var(b), of which two estimates are made. Of neighbours that are equally noisy, the
// product d d' has mean 0 and the square of it a quarter of that, however heavy the tails: right but where noise sits in single pixels, at
// the edges of lamps. There ab itself is (A - m)(B - m), m being the mean around, but never more than what normal errors make likely, of
// which d has a fourth moment 3/4 of that: small where one half has a firefly and the other has none. The larger of both and half the
// smaller have been found to be right (tests/bench/error_coverage.cpp). The ratio of error to estimate is taken to be distributed like
// Fisher's F with as many degrees of freedom above as below, which gives an interval that also holds where few pixels carry the error.
//
// relMSE divides by the truth, which is not there. A pixel stands for itself as far as it differs from the mean around by more than its
// halves differ, and otherwise for that mean, in which it has a small share. What the choice may be worth is measured, not assumed: the
// estimate is made again with the darkest surroundings that a pixel may belong to, and a share of the logarithm of that ratio, calibrated
// against converged references, is added to the interval.
//
// Not known for fewer than 64 pixels; if few of them carry the error; if one more sample of the brightest light in the picture could be a
// good part of it; for relmse, if the interval spans more than a factor of 10.
//
// `sharing`: how many times larger the variance of the sums of products is than if pixels erred independently.
ErrorEstimate estimate_error(const ErrorSums& sums, double sharing = 1);

} // namespace blush
