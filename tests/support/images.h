// Comparison of images bit for bit.
#pragma once

#include "render/renderer.h"
#include "scene/document/edit.h"

#include <gtest/gtest.h>

namespace blush::test {

// All film planes.
RendererOptions all_planes(unsigned threads = 2);

// Samples [first_sample, first_sample + count) of a scene, rendered by a fresh Renderer.
Frame fresh_image(const Scene& scene, const RenderSettings& settings, int64_t count, unsigned threads = 2);

// Pixels and planes, bit for bit; ignores the kernel and timings.
::testing::AssertionResult same_pixels(const Frame& a, const Frame& b);
// A checksum of the same data.
uint64_t checksum(const Frame& frame);

} // namespace blush::test
