#include "tests/render/rendered_image.h"

namespace blush::test {

using namespace statistics;

namespace {

testing::AssertionResult compare(const Vec3d& a, const Vec3d& b, const Vec3d& error, double alpha, double slack) {
    constexpr const char* claims[3] = {"red differs", "green differs", "blue differs"};
    const double each = sidak(alpha, 3);
    const double d[3] = {a.x - b.x, a.y - b.y, a.z - b.z}, e[3] = {error.x, error.y, error.z}, scale[3] = {b.x, b.y, b.z};
    for (int c = 0; c < 3; ++c) {
        if (!std::isfinite(d[c])) return testing::AssertionFailure() << "channel " << c << " is not finite";
        const double beyond = std::copysign(std::max(0.0, std::abs(d[c]) - slack), d[c]);
        if (auto verdict = z_verdict(claims[c], beyond, e[c], scale[c], each); !verdict)
            return verdict << " (" << scale[c] + d[c] << " instead of " << scale[c] << ")";
    }
    return testing::AssertionSuccess();
}

} // namespace

testing::AssertionResult is_mean(const Measured& m, const Vec3d& expected, double alpha, double slack) {
    return compare(m.mean, expected, m.error, alpha, slack);
}
testing::AssertionResult is_mean(const Measured& m, double expected, double alpha, double slack) {
    return is_mean(m, Vec3d{expected, expected, expected}, alpha, slack);
}
testing::AssertionResult same_mean(const Measured& a, const Measured& b, double alpha) {
    const Vec3d error{std::hypot(a.error.x, b.error.x), std::hypot(a.error.y, b.error.y), std::hypot(a.error.z, b.error.z)};
    return compare(a.mean, b.mean, error, alpha, 0);
}
testing::AssertionResult same_means(std::span<const Measured> a, std::span<const Measured> b, double alpha) {
    if (a.size() != b.size() || a.empty()) return testing::AssertionFailure() << a.size() << " blocks and " << b.size();
    for (size_t i = 0; i < a.size(); ++i)
        if (auto verdict = same_mean(a[i], b[i], sidak(alpha, int64_t(a.size()))); !verdict) return verdict << ", block " << i;
    return testing::AssertionSuccess();
}

} // namespace blush::test
