// Learned portals: directions follow their pdf, in the portal alone and in NEE beside lamps and an importance map.
#include "render/integrator/light_sampling.h"
#include "render/lights/learned_portals.h"

#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/random_numbers.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

struct Random : RandomNumbers {
    Random() : RandomNumbers(7) {}
};

Scene lamps_under(bool map) {
    Scene scene;
    place(scene, floor_quad(5), lambert(0.5f));
    Light lamp;
    lamp.kind = Light::Kind::sphere;
    lamp.radius = 0.2f;
    place_light(scene, lamp, at({0, 5, 0}));
    constant_world(scene, 1);
    if (map) {
        std::vector<Vec3> texels;
        for (int i = 0; i < 32; ++i) texels.push_back(i % 8 < 4 ? Vec3{0.2f, 0.3f, 0.5f} : Vec3{3, 2, 1});
        scene.environment.kind = Environment::Kind::image;
        scene.environment.image = float_image(8, 4, texels);
    }
    return scene;
}

// Receivers in a box of 4 m; those of its left half see the sky in `window`.
template <class Window> std::vector<EscapeTrial> trials(const Window& window, float scale = 1, int count = 40'000) {
    Random random;
    std::vector<EscapeTrial> all;
    for (int i = 0; i < count; ++i) {
        const Vec3 position{random(-2, 2), random(-2, 2), random(-2, 2)}, direction = random.direction();
        all.push_back({position * scale, direction, false, position.x < 0 && window(direction)});
    }
    return all;
}
bool to_the_right(const Vec3& d) { return d.x > 0.8f; }

struct Compiled {
    RenderScene scene;
    SceneTables tables;
    LearnedPortals portals;
    explicit Compiled(const Scene& s) {
        RenderSettings settings = settings_for(8, 8, 1);
        settings.mis_compensation = true;
        scene.update(expand_area_lights(s), settings, full_plan(), Workers(1));
        tables = scene.tables();
        portals = LearnedPortals(trials(to_the_right), tables.environment, tables.lights.count == 0);
        tables.lights.portals = portals.tables();
    }
};

TEST(Portals, OpenTowardsTheWindow) {
    const Compiled compiled(lamps_under(false));
    const PortalTables& t = compiled.tables.lights.portals;
    ASSERT_TRUE(t.rows);
    EXPECT_GT(compiled.portals.reach(), 0.3);
    EXPECT_LT(compiled.portals.reach(), 0.7);
    EXPECT_EQ(portal_at<float>(t, {1.5f, 0, 0}).share, 0) << "nothing escapes there";
    const Portal<float> portal = portal_at<float>(t, {-1, 0, 0});
    EXPECT_EQ(portal.share, 0.5f);
    Random random;
    int through = 0;
    constexpr int samples = 4000;
    for (int i = 0; i < samples; ++i) through += to_the_right(sample_portal<float>(t, portal, uint32_t(random.bits()), random()));
    EXPECT_GT(through, samples / 2);
}

TEST(Portals, DirectionsFollowTheirPdf) {
    const Compiled compiled(lamps_under(true));
    const PortalTables& t = compiled.tables.lights.portals;
    const Portal<float> portal = portal_at<float>(t, {-1, 0, 0});
    Random random;
    constexpr int64_t samples = 200'000;
    constexpr double sphere = 4 * std::numbers::pi;
    std::vector<int64_t> counts(portal_bins);
    std::vector<double> expected(portal_bins);
    Moments measure, height;
    for (int64_t i = 0; i < samples; ++i) {
        const Vec3 d = sample_portal<float>(t, portal, uint32_t(random.bits()), random());
        EXPECT_NEAR(dot(d, d), 1, 1e-5);
        ++counts[size_t(portal_bin<float>(d))];
        const double over_pdf = 1 / double(portal_pdf<float>(t, portal, d));
        measure.add(over_pdf);
        height.add(double(d.z * d.z) * over_pdf);
    }
    for (int bin = 0; bin < portal_bins; ++bin)
        expected[size_t(bin)] = samples * double(t.bins[portal.first + bin].pdf) * sphere / portal_bins;
    EXPECT_TRUE(chi_squared_test(counts, expected, sidak(significance, 3)));
    EXPECT_TRUE(z_test(measure, sphere, sidak(significance, 3)));
    EXPECT_TRUE(z_test(height, sphere / 3, sidak(significance, 3)));
}

// Integrals over the sphere with NEE's samples and densities: of lamp and sky together.
TEST(Portals, NeeHasTheStatedDensity) {
    for (const bool map : {false, true}) {
        const Compiled compiled(lamps_under(map));
        const SceneTables& tables = compiled.tables;
        EXPECT_EQ(tables.lights.samples_environment, map);
        Random random;
        for (const float x : {-1.f, 1.5f}) {
            const Receiver<float> to{{x, 0, 0}, {0, 0, 0}};
            Moments sphere, lamps;
            for (int i = 0; i < 100'000; ++i) {
                const Pair<float> pair{uint32_t(random.bits()), uint32_t(random.bits())};
                const LightPoint<float> p = sample_light_point<all_features, float>(tables, pair, to, true);
                const bool sky = p.valid && p.kind == int32_t(LightKind::environment);
                if (sky) {
                    ASSERT_TRUE(p.infinite);
                    ASSERT_NEAR(p.probability * p.density, (environment_nee_pdf<all_features, float>(tables, to, p.position, true)),
                                1e-5f * p.density);
                } else if (p.valid) {
                    ASSERT_NEAR(p.probability, (nee_probability<all_features, float>(tables, to, p.light, true)), 1e-5f);
                }
                sphere.add(sky ? 1 / double(p.probability * p.density) : 0);
                lamps.add(p.valid && !sky ? 1 / double(p.probability) : 0);
            }
            // Only a portal reaches every direction: the compensated map does not.
            if (x < 0) { EXPECT_TRUE(z_test(sphere, 4 * std::numbers::pi, sidak(significance, 8))) << map; }
            EXPECT_TRUE(z_test(lamps, 1, sidak(significance, 8))) << map << " " << x;
        }
    }
}

TEST(Portals, ScaleExactlyWithPowersOfTwo) {
    const Compiled compiled(lamps_under(true));
    const EnvironmentTables& environment = compiled.tables.environment;
    const LearnedPortals expected(trials(to_the_right, 1), environment, false);
    for (const float scale : {0x1p-20f, 0x1p20f}) {
        const LearnedPortals scaled(trials(to_the_right, scale), environment, false);
        EXPECT_EQ(scaled.reach(), expected.reach());
        ASSERT_EQ(scaled.memory_bytes(), expected.memory_bytes());
        const PortalTables a = expected.tables(), b = scaled.tables();
        EXPECT_TRUE(std::equal(a.rows, a.rows + a.grid.count(), b.rows));
    }
}

TEST(Portals, NeedRaysThatEscape) {
    const Compiled compiled(lamps_under(false));
    const EnvironmentTables& environment = compiled.tables.environment;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto none = [](const Vec3&) { return false; };
    const auto all = [](const Vec3&) { return true; };
    EXPECT_FALSE(LearnedPortals({}, environment, false).tables().rows);
    EXPECT_FALSE(LearnedPortals(trials(none), environment, false).tables().rows);
    std::vector<EscapeTrial> lost = trials(to_the_right), mirrored = lost, open = trials(all);
    for (EscapeTrial& t : open) t.escaped = true;
    for (EscapeTrial& t : mirrored) t.is_delta = true;
    EXPECT_FALSE(LearnedPortals(open, environment, false).tables().rows) << "an open sky is left to the BSDF";
    EXPECT_FALSE(LearnedPortals(mirrored, environment, false).tables().rows);
    for (size_t i = 0; i < lost.size(); i += 3) (i % 2 ? lost[i].position.x : lost[i].direction.y) = nan;
    EXPECT_TRUE(LearnedPortals(lost, environment, false).tables().rows);
    for (EscapeTrial& t : lost) t.position.y = nan;
    EXPECT_FALSE(LearnedPortals(lost, environment, false).tables().rows);
}

} // namespace
} // namespace blush::test::TEST_FILE
