// Statistical tests of rendered images.
#pragma once

#include "measure/stability/rendered_image.h"
#include "tests/support/statistics.h"

#include <span>

namespace blush::test {

using namespace stability;

// True if the mean is `expected`. `slack`: uncertainty of the expectation itself.
testing::AssertionResult is_mean(const Measured& m, const Vec3d& expected, double alpha = statistics::significance, double slack = 0);
testing::AssertionResult is_mean(const Measured& m, double expected, double alpha = statistics::significance, double slack = 0);
testing::AssertionResult same_mean(const Measured& a, const Measured& b, double alpha = statistics::significance);
// True if the blocks agree pairwise, at the family-wise significance `alpha`.
testing::AssertionResult same_means(std::span<const Measured> a, std::span<const Measured> b, double alpha = statistics::significance);

} // namespace blush::test
