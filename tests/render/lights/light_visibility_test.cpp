// Learned visibility: from synthetic trials, which lights a receiver prefers, and that no light loses all of its probability.
#include "render/lights/light_visibility.h"

#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

constexpr int lights_count = 6;

// Points of equal intensity near the ceiling, and a sun.
const RenderScene& compiled() {
    static const RenderScene& scene = *[] {
        Scene s;
        place(s, floor_quad(5), lambert(0.5f));
        Light point;
        for (int i = 0; i < lights_count - 1; ++i) place_light(s, point, at({float(i) - 2, 3, 0}));
        Light sun;
        sun.kind = Light::Kind::sun;
        place_light(s, sun, aimed({0, 0, 0}, {0, -1, 0}));
        auto* compiled = new RenderScene;
        compiled->update(expand_area_lights(s), settings_for(8, 8, 1), full_plan(), Workers(1));
        return compiled;
    }();
    return scene;
}

// Valid as long as `learned`.
LightTables with(const LightVisibility& learned) {
    LightTables lights = compiled().tables().lights;
    lights.tree.visibility = learned.grid();
    return lights;
}

float probability(const LightTables& lights, const Vec3& position, const Vec3& normal, int32_t light) {
    return light_probability<all_features, float>(lights, {position, normal}, light, true);
}

// Trials on a floor and a ceiling of 8 x 8 m, 2 m apart; `arrives(position, normal, light)`.
template <class Arrives> std::vector<ShadowTrial> trials(const Arrives& arrives, float scale = 1, int count = 60'000) {
    std::mt19937 bits(5);
    const auto random = [&] { return float(bits() >> 8) * 0x1p-24f; };
    std::vector<ShadowTrial> all;
    for (int i = 0; i < count; ++i) {
        const bool floor = bits() & 1;
        const Vec3 position{8 * random() - 4, floor ? 0.f : 2.f, 8 * random() - 4}, normal{0, floor ? 1.f : -1.f, 0};
        const auto light = int32_t(bits() % lights_count);
        all.push_back({position * scale, normal, light, arrives(position, normal, light)});
    }
    return all;
}

constexpr Vec3 up{0, 1, 0}, down{0, -1, 0};

// A share of a ray counts as a share of the rays.
TEST(LightVisibility, CountsTheLightThatBlendedSurfacesLeave) {
    int number = 0;
    std::vector<ShadowTrial> dimmed = trials([](const Vec3&, const Vec3&, int32_t) { return true; }), blocked = dimmed;
    for (size_t i = 0; i < dimmed.size(); ++i) {
        if (dimmed[i].light != 1) continue;
        dimmed[i].transmittance = 0.25f;
        blocked[i].arrived = number++ % 4 == 0;
    }
    const LightVisibility a(dimmed, compiled().tables().lights), b(blocked, compiled().tables().lights);
    const LightTables with_a = with(a), with_b = with(b);
    const float plain = probability(compiled().tables().lights, {1, 0, 1}, up, 1), found = probability(with_a, {1, 0, 1}, up, 1);
    EXPECT_LT(found, 0.8f * plain);
    EXPECT_NEAR(found, probability(with_b, {1, 0, 1}, up, 1), 0.2f * found);
}

TEST(LightVisibility, PrefersLightsThatTheCellSees) {
    // Light 1 is seen from the left half only, light 2 from the right.
    const auto arrives = [](const Vec3& p, const Vec3&, int32_t light) { return light == 1 ? p.x < 0 : light == 2 ? p.x > 0 : true; };
    const LightVisibility learned(trials(arrives), compiled().tables().lights);
    EXPECT_LT(learned.second_moment(), 0.9);
    EXPECT_GT(learned.memory_bytes(), 0);
    const LightTables lights = with(learned), plain = compiled().tables().lights;
    for (const float z : {-3.f, 0.f, 3.f}) {
        const auto odds = [&](const LightTables& t, float x) {
            return probability(t, {x, 0, z}, up, 1) / probability(t, {x, 0, z}, up, 2);
        };
        EXPECT_GT(odds(lights, -2) / odds(plain, -2), 4);
        EXPECT_LT(odds(lights, 2) / odds(plain, 2), 0.25f);
    }
}

TEST(LightVisibility, KnowsTheTwoSidesOfAWall) {
    const auto arrives = [](const Vec3&, const Vec3& n, int32_t light) { return light == 1 ? n.y > 0 : light == 2 ? n.y < 0 : true; };
    // A sheet: floor and ceiling at one height.
    std::vector<ShadowTrial> sheet = trials(arrives);
    for (ShadowTrial& t : sheet) t.position.y = 1;
    const LightVisibility learned(sheet, compiled().tables().lights);
    const LightTables lights = with(learned), plain = compiled().tables().lights;
    const auto odds = [&](const LightTables& t, const Vec3& normal) {
        const float of_2 = probability(t, {0, 1, 0}, normal, 2);
        return of_2 > 0 ? probability(t, {0, 1, 0}, normal, 1) / of_2 : 0;
    };
    EXPECT_GT(odds(lights, up) / odds(plain, up), 2);
    EXPECT_EQ(odds(plain, down), 0) << "the lights are above";
    // All sides: counted beside the side of its zero normal, without a fault.
    EXPECT_GT(odds(lights, {0, 0, 0}), 0);
}

TEST(LightVisibility, LeavesEveryLightAProbability) {
    const LightVisibility learned(trials([](const Vec3&, const Vec3&, int32_t light) { return light == 3; }), compiled().tables().lights);
    const LightTables lights = with(learned), plain = compiled().tables().lights;
    for (int32_t light = 0; light < lights_count; ++light)
        for (const float x : {-30.f, -3.f, 0.1f, 3.f, 1e20f}) {
            const float before = probability(plain, {x, 0.5f, 1}, up, light), after = probability(lights, {x, 0.5f, 1}, up, light);
            EXPECT_GE(after, before * unlearned_share * (1 - 1e-5f)) << light << " " << x;
        }
}

TEST(LightVisibility, DoesNotDependOnTheOrderOfTheTrials) {
    const auto arrives = [](const Vec3& p, const Vec3&, int32_t light) { return std::sin(3 * p.x + float(light)) > 0; };
    std::vector<ShadowTrial> some = trials(arrives, 1, 5000);
    const LightVisibility learned(some, compiled().tables().lights);
    std::ranges::shuffle(some, std::mt19937(3));
    const LightVisibility again(some, compiled().tables().lights);
    EXPECT_EQ(learned.second_moment(), again.second_moment());
    const LightVisibilityGrid a = learned.grid(), b = again.grid();
    ASSERT_EQ(learned.memory_bytes(), again.memory_bytes());
    EXPECT_TRUE(std::equal(a.factors, a.factors + learned.memory_bytes() / 4, b.factors));
}

// So images of scaled scenes stay equal to the bit.
TEST(LightVisibility, ScalesExactlyWithPowersOfTwo) {
    const auto arrives = [](const Vec3& p, const Vec3&, int32_t light) { return std::sin(3 * p.x + float(light)) > 0; };
    const LightVisibility learned(trials(arrives, 1, 5000), compiled().tables().lights);
    const LightVisibilityGrid a = learned.grid();
    for (const float scale : {0x1p-20f, 0x1p20f}) {
        const LightVisibility scaled(trials(arrives, scale, 5000), compiled().tables().lights);
        const LightVisibilityGrid b = scaled.grid();
        ASSERT_EQ(learned.memory_bytes(), scaled.memory_bytes());
        EXPECT_TRUE(std::equal(a.factors, a.factors + learned.memory_bytes() / 4, b.factors)) << scale;
        EXPECT_EQ(a.grid.low * scale, b.grid.low);
        EXPECT_EQ(a.grid.cells_per_metre, b.grid.cells_per_metre * scale);
    }
}

TEST(LightVisibility, LearnsNothingFromNothing) {
    const LightTables& lights = compiled().tables().lights;
    const float nan = std::numeric_limits<float>::quiet_NaN(), huge = std::numeric_limits<float>::max();
    const std::vector<ShadowTrial> none, point(100, {{1, 2, 3}, up, 0, true}), lost(100, {{nan, 2, 3}, up, 0, true}),
        extreme{{{-huge, 0, 0}, up, 0, true}, {{huge, 0, 0}, up, 0, true}};
    for (const auto& trials : {none, point, lost, extreme}) {
        const LightVisibility learned(trials, lights);
        EXPECT_FALSE(learned.grid().factors);
        EXPECT_EQ(learned.second_moment(), 1);
    }
    // Some lost receivers do not spoil the others, and have a row.
    std::vector<ShadowTrial> some = trials([](const Vec3& p, const Vec3&, int32_t) { return p.x > 0; });
    for (size_t i = 0; i < some.size(); i += 3) some[i].position.x = nan;
    const LightVisibility learned(some, lights);
    ASSERT_TRUE(learned.grid().factors);
    EXPECT_GE((visibility_row<float>(learned.grid(), {nan, nan, nan}, {nan, nan, nan})), 0);
    EXPECT_LT((visibility_row<float>(learned.grid(), {huge, huge, huge}, {0, 0, -1})), learned.memory_bytes() / 4);
}

} // namespace
} // namespace blush::test::TEST_FILE
