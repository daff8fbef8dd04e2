// How often the interval of an error estimate covers the true error: what the test demands and the bench tabulates.
#pragma once

#include "render/frame.h"

#include <cstdint>
#include <vector>

namespace blush::test {

// What a picture would be after endless rendering, as well as it is known: RGB per pixel, and the variance of that.
struct Truth {
    std::vector<Vec3d> mean, variance;
};

struct TrueError {
    double relmse = 0, rmse = 0;
};
// Of the picture in `frame`, what the truth itself lacks taken off.
TrueError true_error(const Frame& frame, const Truth& truth);

struct Coverage {
    int64_t runs = 0;
    int64_t known = 0, covered = 0; // relmse
    int64_t rmse_known = 0, rmse_covered = 0;
    double log_ratio = 0, log_width = 0; // sums over known ones: of estimate / truth, of high / low (relmse)

    void add(const ErrorEstimate& estimate, const TrueError& truth);
    void merge(const Coverage& other);
};

} // namespace blush::test
