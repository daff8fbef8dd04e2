// What the error estimate is made of: sums over the pixels of two half images (error_estimate.h says why these).
#pragma once

#include "render/half_rows.h"

#include <cstdint>

namespace blush {

struct ErrorSums {
    // Of pixels, under one weight: squared half differences, their squares, what ab may be in each, products with neighbours.
    struct Weighted {
        double squares = 0, fourths = 0, own_products = 0, neighbour_products = 0;
        bool operator==(const Weighted&) const = default;
    };
    int64_t pixels = 0, pairs = 0; // whose halves both hold samples; of neighbours among them
    Weighted absolute, relative;
    double relative_high = 0; // squares with the darkest surroundings to divide by
    double unequal = 0;       // squares, each times how much more one half counts than the other
    double brightest = 0;     // square of what one sample of the brightest pixel is to it, at least
    double largest = 0;       // value of the picture, of any channel

    // Adds those of the rows below.
    void merge(const ErrorSums& other);
};

// What normal errors whose half difference has this square would have as the variance of their product.
template <class T> T normal_product(const T& square) { return square * square * (4.f / 3); }

// Over rows [first, last).
ErrorSums sum_errors(const HalvesOfPicture& picture, int first, int last);

} // namespace blush
