// The error of one picture, held against another whose own error is known.
#pragma once

#include "measure/bias_test.h"
#include "measure/convergence.h"
#include "render/denoiser.h"
#include "render/frame.h"

namespace blush {

// Of the time that rendering takes: how much of it measuring pictures meanwhile may take.
constexpr double measuring_share = 0.005;

struct PictureError {
    Interval rmse, relmse; // known: there is an interval that says something
};

// Against a reference whose samples the picture does not share. With p a pixel of the picture, t the truth, r the reference's and e its
// standard error, whose square is an unbiased estimate of r's variance, (p - r)^2 - e^2 has the mean (p - t)^2 exactly, however good the
// reference is. Intervals come from the scatter of that over the pixels, of which what the picture itself adds is no uncertainty: they hold
// more often than 95 %. Not known if 0 is within: the reference tells too little. relMSE divides by the reference's own values. Pixels that
// are not finite are left out. Sizes must agree.
PictureError error_against(const PixelView& picture, const MeasuredImage& reference);

// Against a later picture of the very run that the picture was made from, whose error is `raw_error`. The two share samples, so nothing is
// taken for independent: by the triangle inequality, the error lies within the later picture's own error of their distance. Not known
// unless that is less than half of it.
PictureError error_against(const PixelView& picture, const PixelView& raw, const ErrorEstimate& raw_error);

// What a frame says of itself, or of what it was when that was estimated.
ConvergencePoint estimated_point(const Frame& frame);

} // namespace blush
