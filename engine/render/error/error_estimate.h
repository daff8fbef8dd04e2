// Estimates the error of an image without a reference, from the difference of two independent randomisations of the sampler.
#pragma once

#include "render/error/error_sums.h"
#include "render/error/small_highlights.h"
#include "render/frame.h"

namespace blush {

// Error of the mean of two half images A, B, each an unbiased estimate of the same image, with 95 % intervals.
//
// With errors a and b of the halves, the image (A + B) / 2 has the squared error (a + b)^2 / 4, and the half difference d = (A -
// B) / 2 has the square (a - b)^2 / 4. They differ by ab, whose mean is 0 because the halves are independent, whatever the
// correlation of samples within a half. So this is valid for low-discrepancy points, where the sample variance is not. The sum of
// squared half differences estimates the squared error of this image, not that of an average one: a firefly affects both equally.
//
// What remains is the sum of ab, with variance var(a) var(b), for which there are two estimates. First: for neighbours with equal
// noise, the product d d' has mean 0 and its square has a quarter of that variance as mean, even with heavy tails; it fails where
// noise is concentrated in single pixels, at the edges of lights. Second: ab itself is (A - m)(B - m), m being the neighbourhood
// mean, limited to what is likely for normal errors (for these the fourth moment of d is 3/4 of that variance). It is small where
// only one half has a firefly. The larger of both plus half the smaller has been validated (tests/bench/error_coverage.cpp). The
// ratio of error to estimate is assumed to follow Fisher's F with equal degrees of freedom, which gives an interval that also
// holds where few pixels carry the error.
//
// relMSE divides by the true value, which is unknown. Its estimate shrinks each pixel towards its neighbourhood mean, depending
// on how its deviation compares with the difference of its halves. The effect of this choice is measured: the estimate is
// repeated with the darkest neighbourhood that a pixel may belong to, and a fraction of the logarithm of the ratio, calibrated
// against converged references, is added to the interval. Outliers, of which one half is much brighter than the mean around them, may
// belong to lines of rare light that are brighter than that mean, or be fireflies. The other half is independent, so over all outliers
// it tells how bright these pixels are: the estimate falls as the divisor of brighter ones grows, and the interval is widened.
//
// Unknown for fewer than 64 pixels; if few of them carry the error; if one more sample of the brightest light could be a large
// part of it; for relmse, if the interval spans more than a factor of 10. One more sample: for relmse, of the emission, where the pixel and
// those around it take more of these (edge_pixels.h).
//
// `sharing`: variance of the sums of products relative to independent pixels (path reuse correlates pixels).
ErrorEstimate estimate_error(const ErrorSums& sums, double sharing = 1);

// Raises the upper ends of the intervals by the error of small highlights, which both halves may have missed, if it may be a large part.
// Beyond a factor of 10 between the ends the error is unknown. `samples`: per pixel of an image of this size.
void include_small_highlights(ErrorEstimate& error, const SmallHighlights& highlights, double samples, int width, int height);

} // namespace blush
