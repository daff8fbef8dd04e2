// Converts between images and network input and output, on runs of `count` pixels.
#pragma once

namespace blush::denoise {

// Each encoder writes three of the `channels` interleaved floats of each network pixel, the first at `to`. `from`: three
// components of each pixel, `stride` floats apart.

// NaN becomes 0, values are clamped to [0, max_network_radiance / scale], then exposed and encoded.
void encode_color(const float* from, int stride, int count, float scale, float* to, int channels);
// NaN becomes 0; clamped to [0, 1].
void encode_albedo(const float* from, int stride, int count, float* to, int channels);
// NaN becomes 0; clamped to [-1, 1], then moved to [0, 1].
void encode_normal(const float* from, int stride, int count, float* to, int channels);

// The inverse of encode_color for network output; count * 3 floats. NaN becomes 0, values are clamped to [0, 1].
void decode_color(const float* from, int count, float scale, float* to);

} // namespace blush::denoise
