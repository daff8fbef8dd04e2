// Light tree: selects each light with its stated probability, omits none that contributes, and is close to optimal selection.
#include "core/math.h"
#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/lights/light_visibility.h"
#include "shading/light.h"
#include "tests/render/irradiance.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/many_lights.h"
#include "tests/support/random_numbers.h"

#include <cmath>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

struct Compiled {
    RenderScene scene;
    explicit Compiled(const Scene& s) { scene.update(expand_area_lights(s), settings_for(8, 8, 1), full_plan(), Workers(1)); }
    const LightTables& lights() const { return scene.tables().lights; }
};

struct Random : RandomNumbers {
    Random() : RandomNumbers(17) {}
};

Light random_light(Random& random, int i) {
    Light light;
    light.kind = Light::Kind(i % 6);
    if (light.kind == Light::Kind::sun && i > 6) light.kind = Light::Kind::point;
    light.intensity = std::exp(random(-3, 3));
    light.radius = light.kind == Light::Kind::disk || light.kind == Light::Kind::sphere || i % 2 ? random(0.02f, 0.2f) : 0;
    light.width = random(0.1f, 0.5f);
    light.height = random(0.1f, 0.5f);
    light.outer_cone_radians = random(0.2f, 1.5f);
    light.inner_cone_radians = light.outer_cone_radians * random(0, 1);
    light.two_sided = i % 5 == 0;
    if (i % 4 == 0) light.spread_radians = random(0.2f, 3);
    return light;
}

Scene mixed_scene(int count) {
    Random random;
    Scene scene;
    place(scene, floor_quad(5), lambert(0.5f));
    for (int i = 0; i < count; ++i)
        place_light(scene, random_light(random, i), aimed({random(-4, 4), random(0.5f, 3), random(-4, 4)}, random.direction()));
    constant_world(scene, 0.2f);
    return scene;
}

// Not constant, so that it takes part in light sampling.
Scene varied_sky(Scene scene) {
    scene.environment.kind = Environment::Kind::sky;
    return scene;
}

int64_t record_count(const LightTables& t) {
    // The environment comes last.
    return t.environment + 1;
}

TEST(LightTree, IsBuiltForSeveralLights) {
    const auto built = [](const Scene& scene) {
        const Compiled compiled(scene);
        const bool has_tree = !compiled.lights().tree.empty();
        EXPECT_EQ(compiled.scene.features().has(Feature::light_tree), has_tree);
        return has_tree;
    };
    EXPECT_TRUE(built(mixed_scene(100)));
    EXPECT_TRUE(built(mixed_scene(2)));
    Scene one = mixed_scene(0);
    one.environment = {};
    Light disk;
    disk.kind = Light::Kind::disk;
    disk.radius = 1;
    place_light(one, disk, aimed({0, 2, 0}, {0, -1, 0}));
    EXPECT_FALSE(built(one)) << "a disk is one light, whatever its polygon";
    Light sun;
    sun.kind = Light::Kind::sun;
    place_light(one, sun, aimed({0, 0, 0}, {0, -1, 0}));
    EXPECT_TRUE(built(one));
}

// Tests sampling and the probability for hits. Emitters without area give no light; the sun next to them is selected normally.
TEST(LightTree, IsNotBuiltOfLightsWithoutPower) {
    Scene scene;
    place(scene, sphere(false), emitter(1, 0.5f), at({0, 5, 0}, 1e-24f));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 2;
    place_light(scene, sun, aimed({0, 0, 0}, {1, -1, 0}));
    const Compiled compiled(scene);
    EXPECT_GT(compiled.scene.info().emissive_triangles, 32);
    EXPECT_TRUE(compiled.lights().tree.empty());
    EXPECT_TRUE(shows_on_floor(scene, [](const Vec3d&) { return 2 * std::sqrt(0.5); }));
}

void expect_stated_probabilities(const LightTables& t) {
    Random random;
    constexpr int receivers = 4;
    for (int r = 0; r < receivers; ++r) {
        const Receiver<float> to{{random(-4, 4), random(0, 3), random(-4, 4)}, r == 0 ? Vec3{0, 0, 0} : random.direction()};
        constexpr int64_t samples = 40'000;
        const auto n = size_t(record_count(t));
        std::vector<int64_t> counts(n + 1);
        std::vector<double> expected(n + 1);
        double sum = 0;
        for (size_t i = 0; i < n; ++i) {
            const auto p = double(light_probability<all_features, float>(t, to, int32_t(i), true));
            expected[i] = p * samples;
            sum += p;
        }
        EXPECT_LT(sum, 1 + 1e-5);
        expected[n] = std::max(0.0, 1 - sum) * samples; // the traversal ends in a branch without contribution
        Moments rest;
        for (int64_t i = 0; i < samples; ++i) {
            const auto pick = pick_light<all_features, float>(t, to, {uint32_t(random.bits()), uint32_t(random.bits())}, true);
            ++counts[pick.probability > 0 ? size_t(pick.index) : n];
            if (!(pick.probability > 0)) continue;
            rest.add(double(pick.remainder));
            ASSERT_NEAR(pick.probability, (light_probability<all_features, float>(t, to, pick.index, true)),
                        1e-6 + 1e-4 * pick.probability);
        }
        EXPECT_TRUE(chi_squared_test(counts, expected, sidak(significance, 6 * receivers))) << r;
        EXPECT_TRUE(z_test(rest, 0.5, sidak(significance, 6 * receivers))) << "the remainder is uniform";
    }
}

void expect_stated_probabilities(const Scene& scene) {
    const Compiled compiled(scene);
    expect_stated_probabilities(compiled.lights());
}

TEST(LightTree, SamplesManyLightsWithTheStatedProbability) { expect_stated_probabilities(varied_sky(mixed_scene(60))); }
TEST(LightTree, SamplesFewLightsWithTheStatedProbability) { expect_stated_probabilities(varied_sky(mixed_scene(4))); }
// Each cell, side and group with another visibility.
TEST(LightTree, SamplesByLearnedVisibilityWithTheStatedProbability) {
    for (const int count : {4, 60}) {
        const Compiled compiled(varied_sky(mixed_scene(count)));
        LightTables lights = compiled.lights();
        Random random;
        std::vector<ShadowTrial> trials;
        for (int i = 0; i < 20'000; ++i)
            trials.push_back({{random(-4, 4), random(0, 3), random(-4, 4)},
                              random.direction(),
                              int32_t(random.bits() % uint32_t(lights.count)),
                              random(0, 1) < 0.3f});
        const LightVisibility learned(trials, lights);
        lights.tree.visibility = learned.grid();
        ASSERT_TRUE(lights.tree.visibility.factors);
        expect_stated_probabilities(lights);
    }
}
// More suns than the root of the tree takes.
TEST(LightTree, SamplesManySunsWithTheStatedProbability) {
    Scene scene = varied_sky(mixed_scene(3));
    Random random;
    for (int i = 0; i < max_distant_lights; ++i) {
        Light sun;
        sun.kind = Light::Kind::sun;
        sun.intensity = random(0.1f, 3);
        sun.angle_radians = i % 2 ? 0.02f : 0;
        place_light(scene, sun, aimed({0, 0, 0}, random.direction()));
    }
    EXPECT_GT(Compiled(scene).lights().slot_count, max_distant_lights);
    expect_stated_probabilities(scene);
}

// A weak spot beside a sun: selection by power would find it once in many samples.
TEST(LightTree, SelectsTheLightOfTheReceiver) {
    Scene scene;
    place(scene, floor_quad(5), lambert(0.5f));
    Light sun, spot;
    sun.kind = Light::Kind::sun;
    sun.intensity = 3;
    place_light(scene, sun, aimed({0, 0, 0}, {0.3f, -1, 0}));
    spot.kind = Light::Kind::spot;
    spot.intensity = 0.5f;
    spot.inner_cone_radians = 0.2f;
    spot.outer_cone_radians = 0.3f;
    place_light(scene, spot, aimed({1, 1, 1}, {0, -1, 0}));
    const Compiled compiled(scene);
    const LightTables& t = compiled.lights();
    const auto probability = [&](const Vec3& position, const Vec3& normal, LightKind kind) {
        for (int32_t i = 0; i < 2; ++i)
            if (t.lights[i].kind == int32_t(kind))
                return light_probability<all_features, float>(t, {position - to_float(compiled.scene.origin()), normal}, i, true);
        return -1.f;
    };
    const Vec3 up{0, 1, 0};
    const float sunlight = 3 / std::sqrt(1.09f), share = even_root_share;
    const float spotlight = 0.5f;
    EXPECT_NEAR(probability({1, 0, 1}, up, LightKind::point), (1 - share) * spotlight / (sunlight + spotlight) + share / 2, 0.01f);
    EXPECT_EQ(probability({3, 0, 1}, up, LightKind::point), 0) << "outside the spot's cone";
    EXPECT_EQ(probability({3, 0, 1}, up, LightKind::sun), 1);
    EXPECT_EQ(probability({1, 0, 1}, normalize(Vec3{1, 0.1f, 0}), LightKind::sun), 0) << "faces away from the sun";
}

// A light that contributes by its closed form has a positive probability.
TEST(LightTree, GivesEveryContributingLightAProbability) {
    const Compiled compiled(mixed_scene(200));
    const SceneTables& tables = compiled.scene.tables();
    Random random;
    int64_t asked = 0;
    for (int k = 0; k < 400; ++k) {
        const Receiver<float> to{{random(-4, 4), random(-1, 4), random(-4, 4)}, random.direction()};
        for (int32_t i = 0; i < record_count(tables.lights); ++i) {
            const LightRecord& light = tables.lights.lights[i];
            Vec3 at = light.position;
            if (light.kind == int32_t(LightKind::triangle))
                at = at + (light.edge1 + light.edge2) * (1.f / 3);
            else if (light.kind != int32_t(LightKind::point))
                continue;
            const Vec3 way = at - to.position, wi = way / length(way);
            float strength = dot(wi, to.normal);
            if (light.profile >= 0) strength = std::min(strength, profile_factor<float>(tables.lights.profiles, light.profile, -wi, true));
            if (light.kind == int32_t(LightKind::triangle)) {
                const float cos = -dot(wi, normalize(cross(light.edge1, light.edge2)));
                strength = std::min(strength, light.flags & light_two_sided ? std::abs(cos) : cos);
            }
            if (!(strength > 1e-3f)) continue;
            ++asked;
            ASSERT_GT((light_probability<all_features, float>(tables.lights, to, i, true)), 0) << "light " << i;
        }
    }
    EXPECT_GT(asked, 1000);
}

TEST(LightTree, StrategiesAgree) {
    Scene scene = mixed_scene(0);
    Random random;
    place(scene, quad({-2, 0, -1}, {2, 0, -1}, {2, 2, -1}, {-2, 2, -1}), plastic(0.6f));
    for (int i = 0; i < 48; ++i) {
        Light light;
        light.kind = i % 2 ? Light::Kind::sphere : Light::Kind::rectangle;
        light.radius = 0.15f;
        light.width = light.height = 0.3f;
        light.intensity = random(0.5f, 4);
        place_light(scene, light, aimed({random(-2, 2), random(0.3f, 2), random(-0.8f, 1.5f)}, random.direction()));
    }
    scene.view = looking({0, 1.5f, 4}, {0, 0.6f, 0}, 0.7f);
    EXPECT_FALSE(Compiled(scene).lights().tree.empty());
    const auto blocks = [&](Strategy strategy, int64_t spp) {
        RenderSettings settings = settings_for(16, 16, spp);
        settings.strategy = strategy;
        settings.seed = 1 + uint32_t(strategy);
        return render(scene, settings).blocks(8, 8);
    };
    const auto mis = blocks(Strategy::mis, 256);
    EXPECT_TRUE(same_means(mis, blocks(Strategy::light, 512), sidak(significance, 2))) << "light";
    EXPECT_TRUE(same_means(mis, blocks(Strategy::bsdf, 1024), sidak(significance, 2))) << "bsdf";
}

TEST(LightTree, IsNearTheOracleWithTenThousandLights) {
    constexpr int rooms = 20;
    const Compiled compiled(house(rooms));
    ASSERT_FALSE(compiled.lights().tree.empty());
    const SelectionVariance v = choice_variance(compiled.scene.tables(), rooms, 60);
    EXPECT_LT(v.tree, 3 * v.oracle) << "oracle " << v.oracle << ", tree " << v.tree;
    EXPECT_GT(v.power, 5 * v.tree) << "power " << v.power << ", tree " << v.tree;
}

// The same for rendered images. The uncertainty of the variance, from two seeds, is bounded by independent pixels.
TEST(LightTree, ImagesOfTenThousandLightsAreNearTheOracle) {
    const ImageVariance v = image_variance(20, 64);
    EXPECT_LT(v.rendered, 3 * v.oracle) << "oracle " << v.oracle << ", rendered " << v.rendered;
    EXPECT_GT(v.power, 5 * v.rendered) << "power " << v.power << ", rendered " << v.rendered;
}

} // namespace
} // namespace blush::test::TEST_FILE
