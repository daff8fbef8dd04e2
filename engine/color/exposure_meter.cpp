#include "color/exposure_meter.h"

#include "core/math.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace blush {
namespace {

constexpr size_t min_pixels = 65536; // that are read of a larger image

std::vector<float> luminances(std::span<const float> values, int channels) {
    const size_t pixels = values.size() / size_t(channels), step = std::max<size_t>(1, pixels / min_pixels);
    std::vector<float> found;
    found.reserve(pixels / step + 1);
    for (size_t i = 0; i < pixels; i += step) {
        const float* p = &values[i * size_t(channels)];
        const float y = luminance(Vec3{p[0], p[1], p[2]});
        if (y > 0 && std::isfinite(y)) found.push_back(y);
    }
    return found;
}

} // namespace

float average_exposure(std::span<const float> values, int channels) {
    const std::vector<float> found = luminances(values, channels);
    if (found.empty()) return 0;
    double stops = 0;
    for (const float y : found) stops += std::log2(y);
    return float(std::log2(0.18) - stops / double(found.size()));
}

float highlight_exposure(std::span<const float> values, int channels) {
    const LuminanceRange range = luminance_range(values, channels);
    return range.high > 0 ? -std::log2(range.high) : 0;
}

LuminanceRange luminance_range(std::span<const float> values, int channels) {
    std::vector<float> found = luminances(values, channels);
    if (found.empty()) return {};
    const auto percentile = [&](double p) {
        const auto at = found.begin() + ptrdiff_t(p * double(found.size() - 1));
        std::nth_element(found.begin(), at, found.end());
        return *at;
    };
    return {percentile(0.01), percentile(0.99)};
}

float camera_exposure(float f_number, float seconds, float iso) {
    constexpr float grey = 0.18f, metered = 0.125f; // nits at EV 0
    return std::log2(grey / metered) - std::log2(f_number * f_number / seconds) + std::log2(iso / 100);
}

} // namespace blush
