// Comparison of images bit for bit.
#pragma once

#include "render/renderer.h"
#include "scene/document/edit.h"

#include <functional>
#include <gtest/gtest.h>
#include <initializer_list>
#include <string>

namespace blush::test {

// All film planes.
RendererOptions all_planes(unsigned threads = 2);

// Samples [first_sample, first_sample + count) of a scene, rendered by a fresh Renderer.
Frame fresh_image(const Scene& scene, const RenderSettings& settings, int64_t count, unsigned threads = 2);

// Samples from first_sample up to the last end, in a call for each end.
Frame render_in_steps(const Scene& scene, const RenderSettings& settings, const RendererOptions& options,
                      std::initializer_list<int64_t> ends);

// Calls `test` with the name of each instruction set that this processor has, while kernels are chosen from that set.
void for_each_isa(const std::function<void(const std::string&)>& test);

// Pixels and planes, bit for bit; ignores the kernel and timings.
::testing::AssertionResult same_pixels(const Frame& a, const Frame& b);
// A checksum of the same data.
uint64_t checksum(const Frame& frame);

} // namespace blush::test
