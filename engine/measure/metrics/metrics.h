// Image metrics: MSE, relMSE, MAE, PSNR and FLIP of two images.
#pragma once

#include "core/result.h"
#include "measure/metrics/flip.h"
#include "measure/metrics/rgb_image.h"

#include <array>
#include <cstdint>

namespace blush {

enum class Encoding {
    scene_linear, // EXR, HDR: FLIP is HDR-FLIP, PSNR is of the sRGB encoding of the values clamped to [0, 1]
    display,      // PNG, JPEG: sRGB-encoded in [0, 1]; FLIP is LDR-FLIP
};

// Over all pixels and channels of the values in the files. Pixels that are not finite in either image are counted and excluded
// from all metrics.
struct Metrics {
    double mse = 0;    // mean of (a - b)^2
    double rmse = 0;   // square root of mse
    double relmse = 0; // mean of (a - b)^2 / (b^2 + 0.01)
    double mae = 0;    // mean of |a - b|
    double psnr = 0;   // dB; infinite for equal images
    FlipNumbers flip;  // of the FLIP map
    double max_abs = 0;
    std::array<double, 3> mean_a{}, mean_b{};
    int64_t nonfinite_a = 0, nonfinite_b = 0; // pixels
};

// Compares `a` with the reference `b`. FLIP is much slower than the rest; its numbers are 0 without `with_flip`. Errors: sizes
// differ, no pixel is finite in both.
Result<Metrics> compare(const RgbImage& a, const RgbImage& b, Encoding encoding, bool with_flip = true);

} // namespace blush
