// Light sampling has its stated densities.
#include "shading/light.h"
#include "shading/sphere_light.h"
#include "tests/support/statistics.h"

#include <random>

namespace blush::TEST_FILE {

using namespace statistics;

namespace {

Vec3 to_unit(const Vec3& v) { return v / std::sqrt(dot(v, v)); }

} // namespace

// Directions to the sphere's points are uniform over its cone, from next to its surface to far away; measured in that cone, where a small
// sphere is as well resolved as a large one.
TEST(SphereLight, DirectionsFollowTheCone) {
    std::mt19937 bits{5};
    const auto u = [&] { return float(bits() >> 8) * 0x1p-24f; };
    constexpr int rings = 12, sectors = 24;
    constexpr int64_t samples = 200'000;
    const Vec3 center{0.3f, -0.2f, 0.5f};
    for (const float distance : {1.001f, 1.1f, 2.f, 30.f, 1e3f}) {
        const Vec3 away = to_unit({0.4f, 0.7f, -0.6f}), from = center + away * distance;
        // Positions are known to 2^-24 of their size: seen from afar, that is more than a ring.
        const float radius = distance > 100 ? 10.f : 1.f;
        const float height = sphere_cone_height<float>(dot(center - from, center - from), radius);
        std::vector<int64_t> counts(rings * sectors);
        const Basis<float> frame = basis_around(to_unit(center - from));
        for (int64_t i = 0; i < samples; ++i) {
            const float a = u(), b = u();
            const SpherePoint<float> p = sample_sphere(center, radius, from, a, b);
            ASSERT_EQ(p.height, height);
            ASSERT_NEAR(length(p.position - center), radius, radius * 1e-5f);
            ASSERT_GE(dot(p.normal, to_unit(from - p.position)), -1e-3f) << "on the side that is seen";
            const Vec3 w = frame.to_local(to_unit(p.position - from));
            const double sin2 = double(w.x) * w.x + double(w.y) * w.y, h = sin2 / (1 + std::sqrt(1 - sin2)) / double(height);
            const double turn = std::atan2(w.y, w.x) / (2 * std::numbers::pi) + 0.5;
            ++counts[size_t(std::min(int(h * rings), rings - 1) * sectors + std::min(int(turn * sectors), sectors - 1))];
        }
        EXPECT_TRUE(
            chi_squared_test(counts, std::vector<double>(counts.size(), double(samples) / double(counts.size())), sidak(significance, 5)))
            << distance;
    }
}

TEST(SphereLight, ConeIsItsSolidAngle) {
    for (const double d : {1.0001, 1.5, 10.0, 1e4, 1e9}) {
        const double sin2 = 1 / (d * d), exact = sin2 / (1 + std::sqrt(1 - sin2));
        EXPECT_NEAR(double(sphere_cone_height<float>(float(d * d), 1.f)) / exact, 1, d < 1.001 ? 1e-3 : 1e-6) << d;
    }
    EXPECT_EQ(sphere_cone_height<float>(0.9f, 1.f), 0.f) << "from within";
    EXPECT_EQ(sphere_cone_height<float>(0.f, 1.f), 0.f) << "from the centre";
}

} // namespace blush::TEST_FILE
