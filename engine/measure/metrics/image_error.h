// Error of an image against another image of known error.
#pragma once

#include "measure/convergence/convergence.h"
#include "measure/statistics/bias_test.h"
#include "render/denoise/denoiser.h"
#include "render/frame.h"

namespace blush {

// Maximum share of the render time for measuring errors during a render.
constexpr double max_measuring_share = 0.005;

struct ImageError {
    Interval rmse, relmse; // known: the interval is meaningful
};

// Error against a reference with independent samples. With pixel p, truth t, reference value r and its standard error e (e^2 is
// an unbiased estimate of r's variance), (p - r)^2 - e^2 has the mean (p - t)^2 exactly, whatever the quality of the reference.
// Intervals come from the scatter of this value over the pixels. The image's own noise is part of the error, not an uncertainty,
// so the coverage exceeds 95 %. Unknown if the interval contains 0: the reference is not accurate enough. relMSE divides by the
// reference's values. Excludes pixels that are not finite. Sizes must agree.
ImageError error_against(const PixelView& image, const MeasuredImage& reference);

// Error against a later image `raw` of the same run, whose error is `raw_error`. The two share samples, so independence is not
// assumed: by the triangle inequality the error differs from their distance by at most `raw_error`. Unknown unless that is less
// than half of the distance.
ImageError error_against(const PixelView& image, const PixelView& raw, const ErrorEstimate& raw_error);

// The error estimate of a frame, at the sample count for which it was computed.
ConvergencePoint estimated_point(const Frame& frame);

} // namespace blush
