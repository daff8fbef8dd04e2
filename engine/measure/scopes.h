// A picture as numbers: histograms, waveforms, and statistics of a region. Pixels are 3 values each, in rows, top first.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace blush {

// The axis that values are laid out on: as they are, or in stops from middle grey, log2(value / 0.18).
struct ScopeAxis {
    bool stops = false;
    float low = 0, high = 1;
};
// 0 at the low end, 1 at the high one; minus infinity for what is not a number, and for what has no logarithm where one is needed.
float place_on(const ScopeAxis& axis, float value);

// Red, green, blue, and their luminance (Rec.709; of display-encoded values that is luma).
constexpr int scope_channels = 4;

struct Histogram {
    ScopeAxis axis;
    int bins = 0;
    int64_t pixels = 0;
    std::array<std::vector<uint32_t>, scope_channels> counts; // both ends belong to the axis
    std::array<int64_t, scope_channels> below{}, above{};     // with the counts they sum to the pixels
};
Histogram histogram(std::span<const float> rgb, const ScopeAxis& axis, int bins);

// A histogram of each column of the picture; columns of pixels are shared out evenly.
struct Waveform {
    ScopeAxis axis;
    int columns = 0, levels = 0;
    std::array<std::vector<uint32_t>, scope_channels> counts; // [level * columns + column]; what lies beyond the axis is in its last level
};
Waveform waveform(std::span<const float> rgb, int width, const ScopeAxis& axis, int columns, int levels);

struct Spread {
    int64_t count = 0; // of the values that are finite; the others are left out
    double mean = 0, low = 0, high = 0;
    double deviation = 0; // of the values, not of their mean: root of the mean square about it
};
Spread spread_of(std::span<const float> values);

} // namespace blush
