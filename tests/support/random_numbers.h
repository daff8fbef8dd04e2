// Random numbers, points and directions for tests; the same in each run.
#pragma once

#include "core/vec.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace blush::test {

struct RandomNumbers {
    std::mt19937 bits;
    explicit RandomNumbers(uint32_t seed) : bits(seed) {}

    float operator()(float low = 0, float high = 1) { return low + (high - low) * float(bits() >> 8) * 0x1p-24f; }
    Vec3 point(float reach) { return {(*this)(-reach, reach), (*this)(-reach, reach), (*this)(-reach, reach)}; }
    // Uniform over the sphere.
    Vec3 direction() {
        const float z = (*this)(-1, 1), turn = (*this)(0, 2 * std::numbers::pi_v<float>), r = std::sqrt(1 - z * z);
        return {r * std::cos(turn), r * std::sin(turn), z};
    }
};

} // namespace blush::test
