// Statistical tests of rendered images.
#pragma once

#include "measure/stability/rendered_image.h"
#include "tests/support/statistics.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace blush::test {

using namespace stability;

// True if the mean is `expected`. `slack`: uncertainty of the expectation itself.
testing::AssertionResult is_mean(const Measured& m, const Vec3d& expected, double alpha = statistics::significance, double slack = 0);
testing::AssertionResult is_mean(const Measured& m, double expected, double alpha = statistics::significance, double slack = 0);
testing::AssertionResult same_mean(const Measured& a, const Measured& b, double alpha = statistics::significance);
// True if the blocks agree pairwise, at the family-wise significance `alpha`.
testing::AssertionResult same_means(std::span<const Measured> a, std::span<const Measured> b, double alpha = statistics::significance);

// Means of blocks over independent images.
class BlockMoments {
public:
    void add(std::span<const Measured> blocks) {
        moments_.resize(blocks.size());
        for (size_t i = 0; i < blocks.size(); ++i) {
            const Vec3d& mean = blocks[i].mean;
            moments_[i][0].add(mean.x);
            moments_[i][1].add(mean.y);
            moments_[i][2].add(mean.z);
        }
    }
    std::vector<Measured> measured() const {
        std::vector<Measured> result;
        for (const auto& [r, g, b] : moments_) result.push_back({{r.mean, g.mean, b.mean}, {r.error(), g.error(), b.error()}});
        return result;
    }

private:
    std::vector<std::array<statistics::Moments, 3>> moments_; // RGB
};

} // namespace blush::test
