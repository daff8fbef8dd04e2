// Pictures that must be equal to the last bit.
#pragma once

#include "render/renderer.h"
#include "scene/edit.h"

#include <gtest/gtest.h>

namespace blush::test {

// Every film plane there is.
RendererOptions all_planes(unsigned threads = 2);

// Samples [first_sample, first_sample + count) of a scene, by a Renderer that has seen nothing else.
Frame fresh_picture(const Scene& scene, const RenderSettings& settings, int64_t count, unsigned threads = 2);

// Pixels and planes, bit for bit; not who rendered them, nor how long it took.
::testing::AssertionResult same_picture(const Frame& a, const Frame& b);
// A fingerprint of the same.
uint64_t checksum(const Frame& frame);

} // namespace blush::test
