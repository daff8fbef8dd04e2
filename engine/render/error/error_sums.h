// Sums over the pixels of two half images, from which the error estimate is computed (error_estimate.h has the theory).
#pragma once

#include "render/error/half_buffer_rows.h"

#include <cstdint>

namespace blush {

struct ErrorSums {
    // Sums over pixels for one weighting: squared half differences, their squares, the estimates of var(ab) per pixel and from
    // products of neighbours.
    struct Weighted {
        double squares = 0, fourths = 0, own_products = 0, neighbour_products = 0;
        bool operator==(const Weighted&) const = default;
    };
    int64_t pixels = 0, pairs = 0; // pixels whose halves both hold samples; pairs of neighbours among them
    Weighted absolute, relative;
    double relative_high = 0; // squares divided by the darkest neighbourhood
    // Over outliers: halves of pixels that are more than `outlier_ratio` times the mean around them.
    struct Outliers {
        double loss = 0, loss_squares = 0; // what relative.squares lose where the divisor's value is `brighter` times; squares, by pixel
        double other_half = 0, around = 0; // weighted sums: of the other half, at most the outlier; of the mean around
        bool operator==(const Outliers&) const = default;
    };
    Outliers outliers;
    double unequal = 0;            // squares, each times the relative difference of the weights of the two halves
    double brightest = 0;          // lower bound of the square that one sample of the brightest pixel contributes
    double brightest_emission = 0; // the same of one of its samples of the emission, where it and those around it take more of these
    double largest = 0;            // largest value of the image, of any channel

    // Adds the sums of the rows below.
    void merge(const ErrorSums& other);
};

inline constexpr float outlier_ratio = 3, brighter = 3;

// Variance of the product of two normal errors whose half difference has this square.
template <class T> T normal_product(const T& square) { return square * square * (4.f / 3); }

// Over rows [first, last).
ErrorSums sum_errors(const HalfBufferImage& image, int first, int last);

} // namespace blush
