// Measures the exposure scale and statistics of an image before denoising.
#pragma once

#include "core/parallel.h"
#include "render/denoise/pixel_view.h"

#include <cstdint>

namespace blush::denoise {

// Scales in this range keep all arithmetic within float.
inline constexpr float min_scale_factor = 1e-30f, max_scale = 1e30f;

// 0.18 / the geometric mean of the luminances of blocks of at most 16x16 pixels, excluding black ones; 1 if all are black.
// Non-finite and negative values count as 0. Clamped to [min_scale_factor, max_scale].
float exposure_scale_of(const PixelView& color, int width, int height, const Workers& workers);

struct Inspection {
    double mean_luminance = 0; // non-finite components count as 0
    int64_t unusual = 0;       // pixels with a component outside [0, largest]
};
Inspection inspect(const PixelView& color, int width, int height, float largest, const Workers& workers);

} // namespace blush::denoise
