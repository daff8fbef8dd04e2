// Images for tests of the metrics.
#pragma once

#include "measure/metrics/rgb_image.h"

#include <random>

namespace blush::test {

inline RgbImage constant_image(int width, int height, const Vec3& color) {
    return {width, height, std::vector<Vec3>(size_t(width) * size_t(height), color)};
}

// Independent uniform values in [0, scale).
inline RgbImage random_image(int width, int height, unsigned seed, float scale = 1) {
    std::mt19937 rng(seed);
    std::uniform_real_distribution<float> u(0, scale);
    RgbImage image = constant_image(width, height, {0, 0, 0});
    for (Vec3& p : image.pixels) p = {u(rng), u(rng), u(rng)};
    return image;
}

} // namespace blush::test
