// Tests of what a picture shows.
#pragma once

#include "measure/stability/picture.h"
#include "statistics.h"

#include <span>

namespace blush::test {

using namespace stability;

// Is the mean `expected`? `slack`: how much the expectation itself may be off.
testing::AssertionResult is_mean(const Measured& m, const Vec3d& expected, double alpha = statistics::significance, double slack = 0);
testing::AssertionResult is_mean(const Measured& m, double expected, double alpha = statistics::significance, double slack = 0);
testing::AssertionResult same_mean(const Measured& a, const Measured& b, double alpha = statistics::significance);
// Do the blocks agree one by one, the lot of them at `alpha`?
testing::AssertionResult same_means(std::span<const Measured> a, std::span<const Measured> b, double alpha = statistics::significance);

} // namespace blush::test
