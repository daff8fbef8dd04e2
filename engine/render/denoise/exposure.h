// What an image measures before the network sees it.
#pragma once

#include "core/parallel.h"
#include "render/denoiser.h"

#include <cstdint>

namespace blush::denoise {

// Scales between these keep every step of the arithmetic within float.
inline constexpr float smallest_scale = 1e-30f, largest_scale = 1e30f;

// 0.18 / the geometric mean of the luminances of blocks of at most 16x16 pixels, black ones left out; 1 if all are black. What is
// not finite or negative counts as 0. Within [smallest_scale, largest_scale].
float exposure_scale_of(const PixelView& color, int width, int height, const Workers& workers);

struct Inspection {
    double mean_luminance = 0; // components that are not finite count as 0
    int64_t unusual = 0;       // pixels with a component that is not in [0, largest]
};
Inspection inspect(const PixelView& color, int width, int height, float largest, const Workers& workers);

} // namespace blush::denoise
