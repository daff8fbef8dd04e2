// Error of an image on the screen against the converged image.
#pragma once

#include "color/color_management.h"
#include "measure/statistics/bias_test.h"
#include "render/session/published_frames.h"

namespace blush::bench {

struct ShownError {
    double flip = 0;   // mean of LDR-FLIP of the displayed images
    double relmse = 0; // of the scene-linear values, less the noise of the reference
};

// Images are displayed with the default view, at the exposure that maps the reference's log-average luminance to middle grey.
class ErrorMeter {
public:
    // `color` must outlive it.
    ErrorMeter(const ColorManagement& color, MeasuredImage reference);

    // The raw image, or the denoised one where there is one, as the window draws it: coarse images are enlarged to the size of
    // the reference by linear interpolation of displayed values. `images` must have a frame.
    ShownError of(const Images& images, bool denoised) const;
    // A scene-linear image, coarse or not.
    ShownError of(const RgbImage& shown) const;
    // Of the reference's own noise.
    double reference_relmse() const;

private:
    RgbImage displayed(RgbImage image) const;

    const ColorManagement& color_;
    MeasuredImage reference_;
    float exposure_ev_;
    RgbImage displayed_reference_;
};

// Linear interpolation between the centres of pixels, as GL_LINEAR with clamped edges.
RgbImage enlarged(const RgbImage& image, int width, int height);

} // namespace blush::bench
