// Takes the bias of the network out of a denoised image, as far as the noise of the rendered one lets it be known.
#pragma once

#include "core/vec.h"
#include "render/denoise/pixel_view.h"

#include <span>

namespace blush {

class Workers;

// Adds a smoothed residual (rendered - denoised) to a denoised image. The network shifts colours of large areas, dims lamps and blurs
// small highlights; the rendered image has none of that, but noise. The residual is shrunk towards what coarser pixels of it say, in a
// pyramid of means of 2 x 2 pixels. At each level
//     d = residual - prediction of the coarser level,   b^2 = mean(d^2 - h^2),   w = max(0, b^2 - t s) / mean(d^2)
// and w d is added to the prediction, with means over 7 x 7 pixels. h is half of the signed difference of the two half buffers, so that
// d^2 - h^2 = (a - denoised)(b - denoised) is an unbiased estimate of the squared bias, and s its standard error,
// s^2 = 4 mean(d^2 h^2) / 49, exact for normal noise. t = 1 + 4 / n with n = 49 mean(d^2)^2 / mean(d^4), the number of pixels that rule the
// window: a pixel with a bright sample in both halves is hardly any evidence. This is positive-part James-Stein shrinkage; compare Gu,
// Iglesias-Guitian, Moon 2022, "Neural James-Stein Combiner for Unbiased and Biased Renderings", and Firmino, Frisvad, Jensen 2022,
// "Progressive Denoising of Monte Carlo Rendered Images". Where noise vanishes, the result is the rendered image; where it hides the bias,
// the denoised one. Differences count relative to the luminance of the denoised image.
//
// `denoised`: width * height * 3 values, finite and >= 0, and so they stay. `rendered`: the network's input; pixels that are not finite
// are left as they are, and residuals beyond 1e6 times the luminance are cut. `half_difference`: Frame::half_difference.
// `exposure_scale`: Denoised::exposure_scale. Null workers: on this thread. The result does not depend on the number of threads.
void correct_bias(std::span<float> denoised, const PixelView& rendered, std::span<const Vec3> half_difference, int width, int height,
                  float exposure_scale, const Workers* workers = nullptr);

} // namespace blush
