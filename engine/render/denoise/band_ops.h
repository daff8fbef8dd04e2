// Network operations other than convolutions, on rows of pixels with interleaved channels. T: float, or bfloat16 as its bits.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace blush::denoise {

using Bfloat16 = uint16_t;

// Rounds to nearest, ties to even. Finite values only.
inline Bfloat16 to_bfloat16(float x) {
    const uint32_t bits = std::bit_cast<uint32_t>(x);
    return Bfloat16((bits + 0x7fff + (bits >> 16 & 1)) >> 16);
}
inline float to_float(Bfloat16 x) { return std::bit_cast<float>(uint32_t(x) << 16); }

// Converts a row of pixels; after the channels of each pixel follow the rounding errors of its first `split` channels.
inline void split_row(const float* from, int channels, int split, Bfloat16* to, int width) {
    for (int x = 0; x < width; x++, from += channels, to += channels + split) {
        for (int c = 0; c < channels; c++) to[c] = to_bfloat16(from[c]);
        for (int c = 0; c < split; c++) to[channels + c] = to_bfloat16(from[c] - to_float(to[c]));
    }
}

// 2x2 max pooling. Inputs are outputs of a ReLU, so non-negative, and such floats compare like their bits.
template <class T> void max_pool_rows(const T* upper, const T* lower, T* to, int width, int channels) {
    using Ordered = std::conditional_t<std::is_same_v<T, float>, float, int16_t>;
    for (int x = 0; x < width; x++) {
        const T* a = upper + size_t(2 * x) * channels;
        const T* b = lower + size_t(2 * x) * channels;
        T* out = to + size_t(x) * channels;
        for (int c = 0; c < channels; c++)
            out[c] = T(std::max(std::max(Ordered(a[c]), Ordered(a[c + channels])), std::max(Ordered(b[c]), Ordered(b[c + channels]))));
    }
}

// Copies at least `bytes` in whole vector registers; reads and writes less than one register beyond the end.
inline void copy_over(std::byte* to, const std::byte* from, size_t bytes) {
    struct Register {
        std::byte bytes[16];
    };
    for (size_t i = 0; i < bytes; i += sizeof(Register)) {
        Register r;
        std::memcpy(&r, from + i, sizeof r);
        std::memcpy(to + i, &r, sizeof r);
    }
}

// Writes a row of (each pixel of `half` twice, then the skip connection's channels). Pixels are written in order, so that each
// overwrites what the previous one wrote beyond its end; the row needs room for one more register.
template <class T> void upsample_and_concat_row(const T* half, int half_channels, const T* skip, int skip_channels, T* to, int width) {
    const auto bytes = [](const T* p) { return reinterpret_cast<const std::byte*>(p); };
    for (int x = 0; x < width; x++) {
        T* pixel = to + size_t(x) * (half_channels + skip_channels);
        copy_over(reinterpret_cast<std::byte*>(pixel), bytes(half + size_t(x / 2) * half_channels), half_channels * sizeof(T));
        copy_over(reinterpret_cast<std::byte*>(pixel + half_channels), bytes(skip + size_t(x) * skip_channels), skip_channels * sizeof(T));
    }
}

} // namespace blush::denoise
