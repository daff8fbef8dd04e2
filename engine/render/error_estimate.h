// The error of an image without a reference: from the difference of two independent randomisations of the sampler.
#pragma once

#include "core/vec.h"
#include "render/frame.h"
#include "render/surroundings.h"

#include <cstdint>
#include <span>
#include <vector>

namespace blush {

// A pixel as its two halves have it. Unknown until both hold samples.
struct PixelHalves {
    bool known = false;
    Vec3d a{0, 0, 0}, b{0, 0, 0}; // means
    double weight_a = 0.5;        // what a counts for in the picture, n_a / (n_a + n_b) or a half
    int64_t samples = 0;          // of both
};

// Gathers the pixels of two half images A, B, each an unbiased estimate of the same picture.
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
class ErrorAccumulator {
public:
    // The next row of a picture, from the top; `y` is its number in the surroundings. Rows of one accumulator follow each other.
    void add_row(std::span<const PixelHalves> row, const Surroundings& surroundings, int y);
    // The row before the first, which another accumulator has: neighbours need it.
    void lead_in(std::span<const PixelHalves> row, const Surroundings& surroundings, int y);
    // Adds the rows below.
    void merge(const ErrorAccumulator& other);
    // Of the mean of the halves, with 95 % intervals. Not known for fewer than 64 pixels; if few of them carry the error; if one more
    // sample of the brightest light in the picture could be a good part of it; for relmse, if the interval spans more than a factor of 10.
    ErrorEstimate estimate() const;

private:
    // Of pixels, under one weight: squared half differences, their squares, what ab may be in each, products with neighbours.
    struct Sums {
        double squares = 0, fourths = 0, own_products = 0, neighbour_products = 0;
        void add(double square, double product);
        void merge(const Sums& o);
    };
    // Half differences of a pixel, as they are and over what relmse divides by.
    struct Difference {
        bool known = false;
        Vec3d absolute{0, 0, 0}, relative{0, 0, 0};
    };
    Difference add_pixel(const PixelHalves& pixel, const Surroundings& surroundings, int x, int y);
    void add_neighbours(const Difference& a, const Difference& b);
    double log_variance(const Sums& sums) const;
    double inequality() const;

    int64_t pixels_ = 0, pairs_ = 0;
    Sums absolute_, relative_;
    double relative_high_ = 0; // with the darkest surroundings to divide by
    double unequal_ = 0;       // squares, each times how much more one half counts than the other
    double brightest_ = 0;     // square of what one sample of the brightest pixel is to it
    std::vector<Difference> above_;
};

// The same estimate, told from pixels whose errors are not independent: `sharing` is how many times larger that makes the variance of the
// logarithm of error over estimate.
ErrorEstimate widened(const ErrorEstimate& estimate, double sharing);

} // namespace blush
