// Test images of the denoiser, and measures of their differences.
#pragma once

#include "render/denoise/denoiser.h"

#include <cstdint>
#include <gtest/gtest.h>
#include <span>
#include <string>
#include <vector>

namespace blush::test {

struct Planes {
    int width = 0, height = 0;
    std::vector<float> color, albedo, normal; // three components of each pixel; empty: absent

    DenoiseInput input() const { return {width, height, {color, 3}, {albedo, 3}, {normal, 3}}; }
    Planes without_features() const { return {width, height, color, {}, {}}; }
};

// Loads an image of tests/golden/denoise; throws if it is missing.
Planes golden(const std::string& name);
// Colours, albedo and normals with per-pixel variation around smooth means.
Planes noisy_planes(int width, int height, uint32_t seed = 1);
Planes constant_planes(int width, int height, float value);

// The largest |a - b| / b where |b| is above `floor`, and the mean of |a - b| / b there.
struct Difference {
    double largest = 0, mean = 0;
};
Difference relative_difference(std::span<const float> a, std::span<const float> b, float floor = 0.01f);

// Denoises with the weights in the build tree. Fails the test on errors.
Denoised denoised(const Planes& planes, const DenoiseOptions& options, unsigned threads = 2);
Denoised denoised(Denoiser& denoiser, const Planes& planes, const DenoiseOptions& options);

// True if this machine supports the precision, by the processor's own flags, not by the code under test.
bool has_bfloat16();

} // namespace blush::test
