// Images as these tests handle them, and how far two of them are apart.
#pragma once

#include "render/denoiser.h"

#include <cstdint>
#include <gtest/gtest.h>
#include <span>
#include <string>
#include <vector>

namespace blush::test {

struct Planes {
    int width = 0, height = 0;
    std::vector<float> color, albedo, normal; // three components of each pixel; empty: not there

    DenoiseInput input() const { return {width, height, {color, 3}, {albedo, 3}, {normal, 3}}; }
    Planes without_features() const { return {width, height, color, {}, {}}; }
};

// Of tests/golden/denoise; throws if it is not there.
Planes golden(const std::string& name);
// Colours, albedo and normals that vary from pixel to pixel around smooth means.
Planes noisy_planes(int width, int height, uint32_t seed = 1);
Planes constant_planes(int width, int height, float value);

// The largest |a - b| / b where |b| is above `floor`, and the mean of it.
struct Difference {
    double largest = 0, mean = 0;
};
Difference relative_difference(std::span<const float> a, std::span<const float> b, float floor = 0.01f);

// With the weights of the build. A failure is a failed test.
Denoised denoised(const Planes& planes, const DenoiseOptions& options, unsigned threads = 2);
Denoised denoised(Denoiser& denoiser, const Planes& planes, const DenoiseOptions& options);

// Whether this machine can compute with it.
bool has_bfloat16();

} // namespace blush::test
