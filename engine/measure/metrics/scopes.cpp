#include "measure/metrics/scopes.h"

#include "core/math.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blush {
namespace {

// Red, green, blue and luminance of pixel i.
std::array<float, scope_channels> channels_of(std::span<const float> rgb, size_t i) {
    const Vec3 c{rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]};
    return {c.x, c.y, c.z, luminance(c)};
}

// Bin of t in [0, 1]; 1 belongs to the last bin. -1 below, `count` above.
int cell_of(float t, int count) {
    if (!(t >= 0)) return -1;
    return t > 1 ? count : std::min(int(t * float(count)), count - 1);
}

} // namespace

float axis_position(const ScopeAxis& axis, float value) {
    const float x = axis.stops ? (value > 0 ? std::log2(value / 0.18f) : -std::numeric_limits<float>::infinity()) : value;
    return std::isnan(x) ? -std::numeric_limits<float>::infinity() : (x - axis.low) / (axis.high - axis.low);
}

Histogram histogram(std::span<const float> rgb, const ScopeAxis& axis, int bins) {
    Histogram h{.axis = axis, .bins = bins, .pixels = int64_t(rgb.size() / 3), .counts = {}};
    for (auto& counts : h.counts) counts.assign(size_t(bins), 0);
    for (size_t i = 0; i < rgb.size() / 3; ++i) {
        const auto values = channels_of(rgb, i);
        for (size_t k = 0; k < values.size(); ++k) {
            const int bin = cell_of(axis_position(axis, values[k]), bins);
            if (bin < 0)
                ++h.below[k];
            else if (bin == bins)
                ++h.above[k];
            else
                ++h.counts[k][size_t(bin)];
        }
    }
    return h;
}

Waveform waveform(std::span<const float> rgb, int width, const ScopeAxis& axis, int columns, int levels) {
    Waveform w{.axis = axis, .columns = std::min(columns, width), .levels = levels, .counts = {}};
    for (auto& counts : w.counts) counts.assign(size_t(w.columns) * size_t(levels), 0);
    for (size_t i = 0; i < rgb.size() / 3; ++i) {
        const size_t column = i % size_t(width) * size_t(w.columns) / size_t(width);
        const auto values = channels_of(rgb, i);
        for (size_t k = 0; k < values.size(); ++k) {
            const int level = std::clamp(cell_of(axis_position(axis, values[k]), levels), 0, levels - 1);
            ++w.counts[k][size_t(level) * size_t(w.columns) + column];
        }
    }
    return w;
}

ValueStatistics value_statistics(std::span<const float> values) {
    ValueStatistics s;
    double sum = 0;
    for (const float x : values) {
        if (!std::isfinite(x)) continue;
        s.low = s.count == 0 ? double(x) : std::min(s.low, double(x));
        s.high = s.count == 0 ? double(x) : std::max(s.high, double(x));
        sum += double(x);
        ++s.count;
    }
    if (s.count == 0) return s;
    s.mean = sum / double(s.count);
    double squares = 0;
    for (const float x : values)
        if (std::isfinite(x)) squares += (double(x) - s.mean) * (double(x) - s.mean);
    s.deviation = std::sqrt(squares / double(s.count));
    return s;
}

} // namespace blush
