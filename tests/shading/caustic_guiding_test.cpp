// Caustic guiding: directions have their stated density, and no energy is lost.
#include "shading/caustic_guiding.h"

#include "tests/support/statistics.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace blush::TEST_FILE {

using namespace statistics;

namespace {

const Vec3 up{0, 0, 1};

// Within its cone; measured in double, by the angle.
bool within(const Vec3& w, const CasterSphere& ball) {
    const Vec3d d{w.x, w.y, w.z}, c{ball.center.x, ball.center.y, ball.center.z};
    return std::atan2(length(cross(d, c)), dot(d, c)) < std::asin(double(ball.radius) / length(c));
}

// The part of a hemisphere weighted by the cosine that a cone above the horizon fills: cos theta sin^2 alpha.
double cosine_part(const CasterSphere& ball) {
    const Vec3d c{ball.center.x, ball.center.y, ball.center.z};
    const double d = length(c);
    return c.z / d * std::pow(double(ball.radius) / d, 2);
}

struct Drawn {
    Vec3 w;
    double value; // of cos / pi over its density
};

std::vector<Drawn> draw(const CausticCasterTables& table, int count) {
    std::mt19937 bits(5);
    const auto u = [&] { return float(bits() >> 8) * 0x1p-24f; };
    const CausticGuide<float> guide = caustic_guide_at<float>(table, {0, 0, 0}, up, true);
    std::vector<Drawn> drawn;
    for (int i = 0; i < count; ++i) {
        const float choice = u(), a = u(), b = u();
        const Vec3 w = choice < guide.share ? sample_caster_direction<float>(table, guide, choice / guide.share, a, b)
                                            : sample_cosine_hemisphere(a, b);
        const float cosine = cosine_hemisphere_pdf(w.z);
        drawn.push_back({w, double(cosine) / double(caster_pdf<float>(table, guide, w, cosine))});
    }
    return drawn;
}

template <class Value> Moments moments(const std::vector<Drawn>& drawn, const Value& value) {
    Moments m;
    for (const Drawn& d : drawn) m.add(value(d));
    return m;
}

} // namespace

// Two balls apart, one of them small and far away; and two that hide each other.
TEST(CausticGuide, EstimatorIsUnbiasedOverTheHemisphere) {
    const std::vector<std::vector<CasterSphere>> scenes = {{{{1, 0, 2}, 0.5f}, {{-30, 20, 40}, 0.5f}}, {{{0, 0, 2}, 1}, {{0.1f, 0, 5}, 1}}};
    for (const std::vector<CasterSphere>& balls : scenes) {
        const std::vector<Drawn> drawn = draw({balls.data(), int32_t(balls.size())}, 400'000);
        const double alpha = sidak(significance, 6);
        EXPECT_TRUE(z_test(moments(drawn, [](const Drawn& d) { return d.value; }), 1, alpha)) << "all of it";
        for (const CasterSphere& ball : balls)
            EXPECT_TRUE(z_test(moments(drawn, [&](const Drawn& d) { return within(d.w, ball) ? d.value : 0; }), cosine_part(ball), alpha));
    }
}

TEST(CausticGuide, GuidingFindsABallMoreOften) {
    const CasterSphere ball{{-30, 20, 40}, 0.5f};
    int found = 0;
    constexpr int count = 400'000;
    for (const Drawn& d : draw({&ball, 1}, count)) found += within(d.w, ball);
    // The other paths, fewer by the guided fraction, still find it by BSDF sampling.
    const double expected = guiding_boost * cosine_part(ball) * count;
    EXPECT_NEAR(found, expected, 5 * std::sqrt(expected));
}

TEST(CausticGuide, NoGuidingFromInsideBelowTheHorizonOrWithoutCasters) {
    const CasterSphere around{{0, 0, 0.5f}, 1}, below{{0, 1, -2}, 1}, speck{{0, 0, 5000}, 1};
    for (const CasterSphere& ball : {around, below, speck}) EXPECT_EQ(caustic_guide_at<float>({&ball, 1}, {0, 0, 0}, up, true).share, 0);
    const CasterSphere ahead{{0, 0, 2}, 1};
    EXPECT_EQ(caustic_guide_at<float>({&ahead, 1}, {0, 0, 0}, up, false).share, 0) << "not diffuse";
    const CausticGuide<float> near = caustic_guide_at<float>({&ahead, 1}, {0, 0, 0.9f}, up, true);
    EXPECT_EQ(near.share, max_guided_share);
    EXPECT_EQ(caster_pdf<float>({&below, 1}, caustic_guide_at<float>({&below, 1}, {0, 0, 0}, up, true), up, 0.25f), 0.25f);
}

} // namespace blush::TEST_FILE
