#include "render/denoise/pixels.h"

#include "render/denoise/transfer.h"

#include <algorithm>

namespace blush::denoise {
namespace {

const float perceived_largest = encode_radiance(max_network_radiance);

// NaN becomes 0.
template <class F> F clamped(const F& x, float low, float high) { return select(x == x, min(max(x, F(low)), F(high)), F(0.f)); }

// to[i] = fn(from[i]) in registers, the remainder one by one; both are bit-identical.
template <class Fn> void map(const float* from, float* to, int count, Fn fn) {
    int i = 0;
    for (; i + width<Wide> <= count; i += width<Wide>) store(to + i, fn(load<Wide>(from + i)));
    for (; i < count; i++) to[i] = fn(from[i]);
}

template <class Fn> void encode(const float* from, int stride, int count, float* to, int channels, Fn fn) {
    constexpr int chunk = 64;
    float values[chunk * 3];
    for (int first = 0; first < count; first += chunk) {
        const int pixels = std::min(chunk, count - first);
        for (int i = 0; i < pixels; i++) std::copy_n(from + size_t(first + i) * stride, 3, values + 3 * i);
        map(values, values, 3 * pixels, fn);
        for (int i = 0; i < pixels; i++) std::copy_n(values + 3 * i, 3, to + size_t(first + i) * channels);
    }
}

} // namespace

void encode_color(const float* from, int stride, int count, float scale, float* to, int channels) {
    const float largest = max_network_radiance / scale;
    encode(from, stride, count, to, channels,
           [&](const auto& x) { return encode_radiance(clamped(x, 0.f, largest) * scale) * (1.f / perceived_largest); });
}

void encode_albedo(const float* from, int stride, int count, float* to, int channels) {
    encode(from, stride, count, to, channels, [](const auto& x) { return clamped(x, 0.f, 1.f); });
}

void encode_normal(const float* from, int stride, int count, float* to, int channels) {
    encode(from, stride, count, to, channels, [](const auto& x) { return clamped(x, -1.f, 1.f) * 0.5f + 0.5f; });
}

void decode_color(const float* from, int count, float scale, float* to) {
    map(from, to, 3 * count, [&](const auto& x) { return decode_radiance(clamped(x, 0.f, 1.f) * perceived_largest) / scale; });
}

} // namespace blush::denoise
