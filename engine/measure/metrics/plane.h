// One channel of an image and separable filters over it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace blush {

struct Plane {
    int width = 0, height = 0;
    std::vector<float> values; // width * height

    Plane(int w, int h) : width(w), height(h), values(size_t(w) * size_t(h)) {}
    float* row(int y) { return values.data() + size_t(y) * size_t(width); }
    const float* row(int y) const { return values.data() + size_t(y) * size_t(width); }
};

// Separable filter: `across` along x, `down` along y, both of odd length and centred (correlation, kernels not mirrored). Border
// values are repeated.
Plane filtered(const Plane& plane, std::span<const float> across, std::span<const float> down);

} // namespace blush
