// Exposure meters: which exposure suits a picture.
#pragma once

#include <span>

namespace blush {

// `values` are pixels of `channels` >= 3 scene-linear values, of which the first three are red, green and blue. Pixels that are black,
// negative or not finite are left out; where nothing is left, the answer is 0. Of large pictures every k-th pixel is read, at least 65536
// of them.

// Stops that bring the log-average luminance, the geometric mean, to middle grey, 0.18 (Reinhard et al. 2002, "Photographic tone
// reproduction for digital images", with their usual key).
float average_exposure(std::span<const float> values, int channels);
// Stops that bring the 99th percentile of luminance to 1, the white of views without a tone curve.
float highlight_exposure(std::span<const float> values, int channels);

// The luminances that one per cent of the pixels lie below and above. low = high = 0 where nothing is left.
struct LuminanceRange {
    float low = 0, high = 0;
};
LuminanceRange luminance_range(std::span<const float> values, int channels);

} // namespace blush
