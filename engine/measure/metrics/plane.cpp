#include "measure/metrics/plane.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace blush {
namespace {

Plane filtered_across(const Plane& in, std::span<const float> taps) {
    const int radius = int(taps.size() / 2);
    Plane out(in.width, in.height);
    tbb::parallel_for(0, in.height, [&](int y) {
        const float* row = in.row(y);
        std::vector<float> padded(size_t(in.width + 2 * radius));
        std::fill_n(padded.begin(), radius, row[0]);
        std::copy_n(row, in.width, padded.begin() + radius);
        std::fill_n(padded.end() - radius, radius, row[in.width - 1]);
        float* result = out.row(y);
        for (size_t k = 0; k < taps.size(); ++k)
            for (int x = 0; x < in.width; ++x) result[x] += taps[k] * padded[size_t(x) + k];
    });
    return out;
}

Plane filtered_down(const Plane& in, std::span<const float> taps) {
    const int radius = int(taps.size() / 2);
    Plane out(in.width, in.height);
    tbb::parallel_for(0, in.height, [&](int y) {
        float* result = out.row(y);
        for (int k = 0; k < int(taps.size()); ++k) {
            const float* row = in.row(std::clamp(y + k - radius, 0, in.height - 1));
            for (int x = 0; x < in.width; ++x) result[x] += taps[size_t(k)] * row[x];
        }
    });
    return out;
}

} // namespace

Plane filtered(const Plane& plane, std::span<const float> across, std::span<const float> down) {
    return filtered_down(filtered_across(plane, across), down);
}

} // namespace blush
