// The error of an image without a reference: from the difference of two independent randomisations of the sampler.
#pragma once

#include "core/vec.h"
#include "render/frame.h"

#include <cstdint>

namespace blush {

// Gathers the pixels of two half images A, B, each an unbiased estimate of the same picture. If both have the variance V / n
// for n_A and n_B samples, then E (A - B)^2 n_A n_B / (n_A + n_B)^2 is the variance of their weighted mean, whatever the
// sampler's correlations within a half: honest for low-discrepancy points, for which the sample variance is not. If A and B count for a half
// each, E (A - B)^2 / 4 is the variance of their mean whatever their own variances are.
class ErrorAccumulator {
public:
    // One pixel, RGB; weight_a: what A counts for in the mean, n_A / (n_A + n_B) or a half.
    void add(const Vec3d& a, const Vec3d& b, double weight_a);
    void merge(const ErrorAccumulator& other);
    // relmse (cli.md) of the mean, the mean itself standing in for the reference in the denominator; the 95 % interval comes from the scatter
    // of the pixels' contributions. Not known for fewer than 64 pixels.
    ErrorEstimate estimate() const;

private:
    int64_t pixels_ = 0;
    double sum_ = 0, sum_squares_ = 0;
};

// The same estimate, told from pixels of which up to `sharing` at a time have errors in common (path_reuse.h): the interval is what
// it would be if each such group were one pixel. No correlation within groups can make it wider.
ErrorEstimate widened(const ErrorEstimate& estimate, int sharing);

} // namespace blush
