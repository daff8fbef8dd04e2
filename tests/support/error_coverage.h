// Coverage of the true error by the intervals of error estimates, for the tests and the benchmark.
#pragma once

#include "render/frame.h"

#include <cstdint>
#include <vector>

namespace blush::test {

// The converged image, as well as it is known: RGB per pixel, and its variance.
struct Truth {
    std::vector<Vec3d> mean, variance;
};

struct TrueError {
    double relmse = 0, rmse = 0;
};
// Of the image in `frame`, with the error of the reference itself subtracted.
TrueError true_error(const Frame& frame, const Truth& truth);

struct Coverage {
    int64_t runs = 0;
    int64_t known = 0, covered = 0; // relmse
    int64_t rmse_known = 0, rmse_covered = 0;
    double log_ratio = 0, log_width = 0; // sums over known ones: log(estimate / truth), log(high / low) (relmse)

    void add(const ErrorEstimate& estimate, const TrueError& truth);
    void merge(const Coverage& other);
};

} // namespace blush::test
