// Scopes: histograms, waveforms and statistics of a region. Pixels have 3 values, top row first.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace blush {

// Axis of a scope: linear, or in stops from middle grey, log2(value / 0.18).
struct ScopeAxis {
    bool stops = false;
    float low = 0, high = 1;
};
// 0 at the low end, 1 at the high end; -infinity for NaN, and for values without a logarithm on a logarithmic axis.
float axis_position(const ScopeAxis& axis, float value);

// Red, green, blue and luminance (Rec.709; luma for display-encoded values).
constexpr int scope_channels = 4;

struct Histogram {
    ScopeAxis axis;
    int bins = 0;
    int64_t pixels = 0;
    std::array<std::vector<uint32_t>, scope_channels> counts; // both ends included
    std::array<int64_t, scope_channels> below{}, above{};     // below + counts + above = pixels
};
Histogram histogram(std::span<const float> rgb, const ScopeAxis& axis, int bins);

// A histogram per column; pixel columns are distributed evenly.
struct Waveform {
    ScopeAxis axis;
    int columns = 0, levels = 0;
    std::array<std::vector<uint32_t>, scope_channels> counts; // [level * columns + column]; end levels include values beyond
};
Waveform waveform(std::span<const float> rgb, int width, const ScopeAxis& axis, int columns, int levels);

struct ValueStatistics {
    int64_t count = 0; // of finite values; others are excluded
    double mean = 0, low = 0, high = 0;
    double deviation = 0; // standard deviation of the values, not of the mean
};
ValueStatistics value_statistics(std::span<const float> values);

} // namespace blush
