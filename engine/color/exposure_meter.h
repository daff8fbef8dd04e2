// Exposure meters: compute a suitable exposure for an image, and the exposure of a camera's settings.
#pragma once

#include <span>

namespace blush {

// `values` are pixels of `channels` >= 3 scene-linear values, of which the first three are red,
// green and blue. Pixels that are black, negative or not finite are skipped; the result is 0 if
// none is left. Large images are subsampled to every k-th pixel, at least 65536 of them.

// Stops that map the log-average luminance (geometric mean) to middle grey, 0.18 (Reinhard et al. 2002, "Photographic tone
// reproduction for digital images", with their default key).
float average_exposure(std::span<const float> values, int channels);
// Stops that map the 99th percentile of luminance to 1, the white of views without a tone curve.
float highlight_exposure(std::span<const float> values, int channels);

// The 1 % and 99 % quantiles of luminance. low = high = 0 if no pixel is valid.
struct LuminanceRange {
    float low = 0, high = 0;
};
LuminanceRange luminance_range(std::span<const float> values, int channels);

// Stops of a camera's settings: middle grey, 0.18, is what a reflected-light meter with K = 12.5 cd/m2 s shows as medium
// (ISO 2720:1974).
float camera_exposure(float f_number, float seconds, float iso);

} // namespace blush
