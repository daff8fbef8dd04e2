// The error of an image without a reference: from the difference of two independent randomisations of the sampler.
#pragma once

#include "core/vec.h"
#include "render/frame.h"

#include <cstdint>
#include <span>
#include <vector>

namespace blush {

// Means over the 5 x 5 pixels around each pixel of a band of rows, itself included; at the border, of those that are there.
class Surroundings {
public:
    // rgba: 4 floats per pixel, width * height of them. Rows [first_row, last_row).
    Surroundings(std::span<const float> rgba, int width, int height, int first_row, int last_row);
    Vec3d mean(int x, int y) const;

private:
    int width_, height_, first_; // first_: the row that sums_ begins with
    std::vector<Vec3> sums_;     // over the 5 columns around
};

// Gathers the pixels of two half images A, B, each an unbiased estimate of the same picture.
//
// With a and b for their errors, the picture (A + B) / 2 has the squared error (a + b)^2 / 4 and the half difference (A - B) / 2 has the
// square (a - b)^2 / 4. They differ by ab, whose mean is 0 because the halves are independent, whatever correlations a sampler has within a
// half: honest for low-discrepancy points, for which the sample variance is not. So the sum of squared half differences estimates the
// squared error of this very picture, not of one like it: a firefly is in both alike. What is left over is the sum of ab, of variance
// var(a) var(b), and a half difference's fourth moment is 3/4 of that if errors are normal. The ratio of error to estimate is then
// distributed like Fisher's F with as many degrees of freedom above as below, which gives an interval that also holds where few pixels
// carry the error.
//
// relMSE divides by the reference, which is not there. A pixel's own value errs most where the error is largest: the smaller one
// of it and of the mean around it stands in. What the choice may be worth is measured, not assumed: the estimate is made again with the
// largest and the smallest values that the pixel, its surroundings and the two halves would allow, and a share of the logarithm of that
// ratio, calibrated against converged references (tests/bench/error_coverage.cpp), is added to the interval.
class ErrorAccumulator {
public:
    // One pixel, RGB. weight_a: what A counts for in the picture, n_A / (n_A + n_B) or a half. around: the mean around it.
    void add(const Vec3d& a, const Vec3d& b, double weight_a, const Vec3d& around);
    void merge(const ErrorAccumulator& other);
    // Of the mean that add() was told of, with 95 % intervals. Not known for fewer than 64 pixels, if hardly more than one of them carries
    // the error, or if the interval of relmse spans more than a factor of 100.
    ErrorEstimate estimate() const;

private:
    // Squared half differences of pixels, and their squares.
    struct Sums {
        double squares = 0, fourths = 0;
        void add(double square) { squares += square, fourths += square * square; }
        void merge(const Sums& o) { squares += o.squares, fourths += o.fourths; }
    };
    double log_variance(const Sums& sums) const;

    int64_t pixels_ = 0;
    Sums absolute_, relative_;
    double relative_low_ = 0, relative_high_ = 0; // with the largest and the smallest values to divide by
    double unequal_ = 0;                          // squares, each times how much more one half counts than the other
};

// The same estimate, told from pixels of which up to `sharing` at a time have errors in common (path_reuse.h): the interval is what
// it would be if each such group were one pixel. No correlation within groups can make it wider.
ErrorEstimate widened(const ErrorEstimate& estimate, int sharing);

} // namespace blush
