// What the network does between convolutions, on rows of pixels with interleaved channels. T: float, or bfloat16 as its bits.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace blush::denoise {

using Bfloat16 = uint16_t;

// Rounds to nearest, ties to even. For finite values.
inline Bfloat16 to_bfloat16(float x) {
    const uint32_t bits = std::bit_cast<uint32_t>(x);
    return Bfloat16((bits + 0x7fff + (bits >> 16 & 1)) >> 16);
}
inline float to_float(Bfloat16 x) { return std::bit_cast<float>(uint32_t(x) << 16); }

// A row of pixels; behind the channels of each, what rounding took from the first `split` of them.
inline void split_row(const float* from, int channels, int split, Bfloat16* to, int width) {
    for (int x = 0; x < width; x++, from += channels, to += channels + split) {
        for (int c = 0; c < channels; c++) to[c] = to_bfloat16(from[c]);
        for (int c = 0; c < split; c++) to[channels + c] = to_bfloat16(from[c] - to_float(to[c]));
    }
}

// The largest of each 2x2 pixels. What comes out of a ReLU is not negative, and such numbers are ordered like their bits.
template <class T> void pool_rows(const T* upper, const T* lower, T* to, int width, int channels) {
    using Ordered = std::conditional_t<std::is_same_v<T, float>, float, int16_t>;
    for (int x = 0; x < width; x++) {
        const T* a = upper + size_t(2 * x) * channels;
        const T* b = lower + size_t(2 * x) * channels;
        T* out = to + size_t(x) * channels;
        for (int c = 0; c < channels; c++)
            out[c] = T(std::max(std::max(Ordered(a[c]), Ordered(a[c + channels])), std::max(Ordered(b[c]), Ordered(b[c + channels]))));
    }
}

// Copies at least `bytes`, a vector register at a time; what it writes beyond, and reads beyond, is less than one register.
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

// A row of (each pixel of `half` twice, then the skipped one's channels). Pixels are written in order, so that each covers what
// its predecessor wrote beyond its end; behind the row there must be room for a register.
template <class T> void double_and_join_row(const T* half, int half_channels, const T* skip, int skip_channels, T* to, int width) {
    const auto bytes = [](const T* p) { return reinterpret_cast<const std::byte*>(p); };
    for (int x = 0; x < width; x++) {
        T* pixel = to + size_t(x) * (half_channels + skip_channels);
        copy_over(reinterpret_cast<std::byte*>(pixel), bytes(half + size_t(x / 2) * half_channels), half_channels * sizeof(T));
        copy_over(reinterpret_cast<std::byte*>(pixel + half_channels), bytes(skip + size_t(x) * skip_channels), skip_channels * sizeof(T));
    }
}

} // namespace blush::denoise
