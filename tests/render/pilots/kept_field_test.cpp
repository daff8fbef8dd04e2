// What edits leave of the field of path guiding, that it biases nothing, and that all images after the first sample are those of a fresh
// start.
#include "render/pilots/kept_field.h"

#include "scene/affine.h"
#include "tests/render/pilots/pilot_checks.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/images.h"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

constexpr const char* feature = "path guiding";
constexpr double degree = std::numbers::pi / 180;

// A glass ball over a floor, in the sun; a small lamp and a box of cloth that focuses nothing.
struct Stage {
    Scene scene;
    Id<Node> floor, ball, box, sun, lamp;

    Stage() {
        floor = place(scene, floor_quad(3), lambert(0.7f));
        ball = place(scene, sphere(false), glass(0, 1.5f), at({0, 1, 0}, 0.7f));
        box = place(scene, sphere(false), lambert(0.4f), at({-1.5f, 0.3f, 0.5f}, 0.25f));
        Light light;
        light.kind = Light::Kind::sun;
        light.angle_radians = 0.2f;
        light.intensity = 3;
        sun = place_light(scene, light, aimed({0, 5, 0}, {0.3f, -1, 0.2f}));
        light = {};
        light.kind = Light::Kind::point;
        light.radius = 0.1f;
        light.intensity = 0.1f;
        lamp = place_light(scene, light, at({0, 3, 0}));
        scene.view = looking({0, 2, 5}, {0, 0.5f, 0}, 0.6f);
    }
    Scene with_light(Id<Node> node, const std::function<void(Light&)>& change) const {
        Scene s = scene;
        Light light = *s.lights.find(s.nodes.find(node)->light);
        change(light);
        s.lights.set(s.nodes.find(node)->light, light);
        return s;
    }
    Scene with_node(Id<Node> id, const std::function<void(Node&)>& change) const {
        Scene s = scene;
        Node node = *s.nodes.find(id);
        change(node);
        s.nodes.set(id, node);
        return s;
    }
    Scene with_material(Id<Node> node, const std::function<void(Material&)>& change) const {
        Scene s = scene;
        const Id<Material> id = s.meshes.find(s.nodes.find(node)->mesh)->parts[0].material;
        Material material = *s.materials.find(id);
        change(material);
        s.materials.set(id, material);
        return s;
    }
    Scene brighter() const {
        return with_light(sun, [](Light& l) { l.intensity *= 2; });
    }
    Scene with_sun_turned() const {
        return with_node(sun, [](Node& n) { n.local = aimed({0, 5, 0}, {0.37f, -1, 0.2f}); });
    }
};

// Without the strategies that leave nothing to path guiding.
RenderSettings guided(int width, int height, int64_t spp) {
    RenderSettings settings = settings_for(width, height, spp);
    settings.caustics = CausticStrategy::guiding;
    return settings;
}
RenderSettings settings_of(int64_t spp) { return guided(80, 48, spp); }

// With one caster, the ball.
FieldEffect effect(const Stage& stage, const Scene& after, const RenderSettings& settings = settings_of(4)) {
    const CasterSphere ball{{0, 1, 0}, 0.7f};
    return effect_on_field(stage.scene, after, diff(stage.scene, settings_of(4), after, settings), {&ball, 1}, {0, 0, 0});
}
void expect_kept(const FieldEffect& e, const char* what) {
    EXPECT_FALSE(e.dropped) << what;
    EXPECT_EQ(e.factor, 1) << what;
    EXPECT_TRUE(e.cleared.empty()) << what;
    EXPECT_EQ(e.edits, 1) << what;
}

TEST(FieldEffect, LightViewAndMaterialEditsKeepTheField) {
    const Stage stage;
    expect_kept(effect(stage, stage.brighter()), "intensity");
    expect_kept(effect(stage, stage.with_light(stage.sun, [](Light& l) { l.color = {1, 0.5f, 0.2f}; })), "colour");
    expect_kept(effect(stage, stage.with_light(stage.lamp, [](Light& l) { l.enabled = false; })), "switch");
    expect_kept(effect(stage, stage.with_material(stage.floor, [](Material& m) { m.base_color = {0.1f, 0.5f, 0.3f}; })), "base colour");
    expect_kept(effect(stage, stage.with_material(stage.ball, [](Material& m) { m.ior = 1.4f; })), "index of refraction");
    Scene other = stage.scene;
    other.view = looking({1, 2, 5}, {0, 0.5f, 0}, 0.6f);
    expect_kept(effect(stage, other), "view");
    other = stage.scene;
    other.mix.grouping = LightMix::Grouping::by_light;
    expect_kept(effect(stage, other), "mix");
    RenderSettings settings = settings_of(4);
    settings.max_bounces = 5;
    expect_kept(effect(stage, stage.scene, settings), "bounces");
    EXPECT_EQ(effect(stage, stage.scene).edits, 0);
}

TEST(FieldEffect, MovedLightsLetItDecay) {
    const Stage stage;
    const auto turned = [&](double angle) {
        return effect(stage, stage.with_node(stage.sun,
                                             [&](Node& n) {
                                                 Affined a = to_affine(n.local);
                                                 const Vec3d y = a.y, z = a.z;
                                                 a.y = y * std::cos(angle) + z * std::sin(angle);
                                                 a.z = z * std::cos(angle) - y * std::sin(angle);
                                                 n.local = to_transform(a);
                                             }))
            .factor;
    };
    EXPECT_NEAR(turned(4 * degree), 0.5, 1e-3);
    EXPECT_NEAR(turned(12 * degree), 0.125, 1e-3);
    // The lamp is two metres above the centre of the ball.
    const auto moved = [&](float x) {
        return effect(stage, stage.with_node(stage.lamp, [&](Node& n) { n.local = at({x, 3, 0}); })).factor;
    };
    EXPECT_NEAR(moved(float(2 * std::tan(4 * degree))), 0.5, 1e-3);
    EXPECT_LT(effect(stage, stage.with_light(stage.lamp, [](Light& l) { l.radius = 0.3f; })).factor, 1);
    Scene sky = stage.scene;
    constant_world(sky, 1);
    EXPECT_TRUE(effect(stage, sky).dropped);
}

TEST(FieldEffect, ChainsStayTheSameWithTheirLightsAndCasters) {
    const Stage stage;
    const auto same = [&](const Scene& after) { return effect(stage, after).same_chains; };
    EXPECT_TRUE(same(stage.brighter()));
    EXPECT_TRUE(same(stage.with_sun_turned()));
    EXPECT_TRUE(same(stage.with_material(stage.floor, [](Material& m) { m.base_color = {0.1f, 0.5f, 0.3f}; })));
    EXPECT_TRUE(same(stage.with_node(stage.box, [](Node& n) { n.local = at({1.5f, 0.3f, 0.5f}, 0.25f); })));
    Scene other = stage.scene;
    other.view = looking({1, 2, 5}, {0, 0.5f, 0}, 0.6f);
    EXPECT_TRUE(same(other));
    // The tables of lights, or the chains, are others.
    EXPECT_FALSE(same(stage.with_light(stage.lamp, [](Light& l) { l.enabled = false; })));
    EXPECT_FALSE(same(stage.with_light(stage.lamp, [](Light& l) { l.intensity = 0; })));
    EXPECT_FALSE(same(stage.with_light(stage.lamp, [](Light& l) { l.radius = 0; })));
    EXPECT_FALSE(same(stage.with_node(stage.lamp, [](Node& n) { n.visible = false; })));
    EXPECT_FALSE(same(stage.with_material(stage.ball, [](Material& m) { m.ior = 1.4f; })));
    EXPECT_FALSE(same(stage.with_material(stage.floor, [](Material& m) { m.emissive = {1, 1, 1}; })));
    EXPECT_FALSE(same(stage.with_material(stage.box, [](Material& m) { m.metallic = 1, m.roughness = 0; })));
    RenderSettings settings = settings_of(4);
    settings.max_bounces = 5;
    EXPECT_FALSE(effect(stage, stage.scene, settings).same_chains);
}

TEST(FieldEffect, GeometryClearsTheCellsThatItTouches) {
    const Stage stage;
    FieldEffect e = effect(stage, stage.with_node(stage.box, [](Node& n) { n.local = at({1.5f, 0.3f, 0.5f}, 0.25f); }));
    EXPECT_FALSE(e.dropped);
    EXPECT_EQ(e.factor, 1) << "it focuses nothing";
    ASSERT_EQ(e.cleared.size(), 2u);
    EXPECT_NEAR(e.cleared[0].center().x, -1.5, 1e-5);
    EXPECT_NEAR(e.cleared[1].center().x, 1.5, 1e-5);
    e = effect(stage, stage.with_node(stage.box, [](Node& n) { n.visible = false; }));
    EXPECT_GE(e.cleared.size(), 1u);
    e = effect(stage, stage.with_node(stage.ball, [](Node& n) { n.local = at({0.1f, 1, 0}, 0.7f); }));
    EXPECT_LT(e.factor, 1) << "the caustic moves with its caster";
    EXPECT_EQ(e.cleared.size(), 2u);
    Scene crowd = stage.scene;
    for (int i = 0; i < 40; ++i) place(crowd, sphere(false), lambert(0.4f), at({0.1f * float(i), 0.3f, 1}, 0.02f));
    EXPECT_TRUE(effect(stage, crowd).dropped);
}

RendererOptions trained() {
    RendererOptions options = all_planes();
    options.begins_trained = true;
    return options;
}

// Has learned `before`, and shows `after`, without a sample.
void edit(Renderer& renderer, const Scene& before, const Scene& after, const RenderSettings& settings) {
    renderer.update(before, settings);
    ASSERT_TRUE(renderer.render(0, 2));
    renderer.update(after, settings);
}

TEST(KeptField, ImagesAfterTheFirstSampleAreThoseOfAFreshStart) {
    const Stage stage;
    for (const bool adaptive : {false, true}) {
        RenderSettings settings = settings_of(4);
        settings.adaptive = adaptive;
        for (const Scene& after : {stage.brighter(), stage.with_sun_turned()}) {
            const Frame fresh = fresh_image(after, settings, 4), first = fresh_image(after, settings, 1);
            Renderer renderer(trained());
            edit(renderer, stage.scene, after, settings);
            ASSERT_TRUE(renderer.render(0, 1));
            EXPECT_FALSE(same_pixels(renderer.resolve(), first)) << "nothing was kept";
            EXPECT_TRUE(feature_line(renderer, feature).used);
            EXPECT_FALSE(renderer.save_film(0)) << "it depends on the edit";
            ASSERT_TRUE(renderer.render(1, 3));
            EXPECT_TRUE(same_pixels(renderer.resolve(), fresh));
            EXPECT_TRUE(renderer.save_film(0));
            EXPECT_EQ(feature_line(renderer, feature).why, decided_line(after, settings, feature).why);

            edit(renderer, stage.scene, after, settings);
            ASSERT_TRUE(renderer.render(0, 1));
            ASSERT_TRUE(renderer.settle_first_sample());
            EXPECT_TRUE(same_pixels(renderer.resolve(), first));
            EXPECT_TRUE(renderer.save_film(0));
            ASSERT_TRUE(renderer.render(1, 3));
            EXPECT_TRUE(same_pixels(renderer.resolve(), fresh));
            EXPECT_EQ(renderer.resolve().rays.bounce, fresh.rays.bounce) << "the rays of discarded samples are not those of the image";
        }
    }
}

// The edit leaves so little of the sun that only the lamp, which has no size, has a caustic: light paths alone find it, also in the first
// sample, which is rendered again without the field.
TEST(KeptField, LeavesTheCausticsOfZeroSizeLights) {
    Stage stage;
    stage.scene = stage.with_light(stage.lamp, [](Light& l) { l.radius = 0; });
    const Scene after = stage.with_light(stage.sun, [](Light& l) { l.intensity *= 1e-4f; });
    RenderSettings settings = settings_for(80, 48, 4);
    settings.caustics = CausticStrategy::automatic;
    const RendererOptions options{.threads = 2, .planes = {}, .caustics = {.manifold_sampling = false}, .begins_trained = true};
    Renderer fresh(options), renderer(options);
    fresh.update(after, settings);
    ASSERT_TRUE(fresh.render(0, 4));
    ASSERT_NE(feature_line(fresh, "light paths").why.find("they alone find caustics of lights of zero size"), std::string::npos);
    edit(renderer, stage.scene, after, settings);
    ASSERT_TRUE(renderer.render(0, 1));
    ASSERT_TRUE(feature_line(renderer, feature).used) << "the first sample has nothing of the field";
    ASSERT_TRUE(renderer.render(1, 3));
    EXPECT_TRUE(same_pixels(renderer.resolve(), fresh.resolve()));
}

// Without the option nothing depends on earlier edits.
TEST(KeptField, IsNotUsedUnlessAskedFor) {
    const Stage stage;
    Renderer renderer(all_planes());
    edit(renderer, stage.scene, stage.brighter(), settings_of(4));
    ASSERT_TRUE(renderer.render(0, 1));
    EXPECT_TRUE(same_pixels(renderer.resolve(), fresh_image(stage.brighter(), settings_of(4), 1)));
    EXPECT_FALSE(feature_line(renderer, feature).used);
}

TEST(KeptField, IsNotUsedWhereManifoldSamplingPays) {
    const Stage stage;
    RenderSettings settings = settings_of(4);
    settings.caustics = CausticStrategy::automatic;
    for (const bool manifolds : {false, true}) {
        Renderer renderer({.threads = 2, .planes = {}, .caustics = {.manifold_sampling = manifolds}, .begins_trained = true});
        edit(renderer, stage.scene, stage.brighter(), settings);
        ASSERT_TRUE(renderer.render(0, 1));
        EXPECT_EQ(feature_line(renderer, feature).used, !manifolds);
    }
}

// A drag: no pilot runs between the edits.
TEST(KeptField, LastsOverEditsThatNoPilotFollows) {
    const Stage stage;
    Renderer renderer(trained());
    edit(renderer, stage.scene, stage.brighter(), settings_of(4));
    const auto use_after = [&](const Scene& scene, int divider = 1) {
        renderer.update(scene, settings_of(4));
        renderer.set_divider(divider);
        EXPECT_TRUE(renderer.render(0, 1));
        return feature_line(renderer, feature);
    };
    const FeatureUse once = use_after(stage.brighter()), twice = use_after(stage.scene);
    EXPECT_TRUE(once.why.starts_with("directions learned 1 edit ago")) << once.why;
    EXPECT_TRUE(twice.why.starts_with("directions learned 2 edits ago")) << twice.why;
    EXPECT_GT(twice.bytes.value_or(0), 0);
    EXPECT_FALSE(twice.pilot) << "this image has had none";
    EXPECT_FALSE(use_after(stage.scene, 4).used) << "coarse images go without";
    EXPECT_TRUE(use_after(stage.scene).used);
    Scene sky = stage.scene;
    constant_world(sky, 1);
    EXPECT_FALSE(use_after(sky).used);
    EXPECT_FALSE(use_after(stage.scene).used) << "what was dropped stays so";
}

// Directions learned for another sun cost variance and no bias.
TEST(KeptField, OfAnotherLightBiasesNothing) {
    const Stage stage;
    const Scene after = stage.with_sun_turned();
    RenderSettings settings = settings_for(32, 24, 4096);
    settings.strategy = Strategy::bsdf;
    settings.seed = 77;
    const auto by_chance = render(after, settings).blocks(8, 8);
    settings = guided(32, 24, 4);
    BlockMoments moments;
    Renderer renderer({.threads = 2, .planes = {}, .begins_trained = true});
    for (uint32_t seed = 0; seed < 96; ++seed) {
        settings.seed = seed;
        edit(renderer, stage.scene, after, settings);
        ASSERT_TRUE(renderer.render(0, 1));
        ASSERT_TRUE(feature_line(renderer, feature).used);
        moments.add(image_of(renderer).blocks(8, 8));
    }
    const std::vector<Measured> kept = moments.measured();
    EXPECT_TRUE(same_means(kept, by_chance));
    EXPECT_FALSE(same_means(kept, render(stage.scene, settings_for(32, 24, 256)).blocks(8, 8))) << "the sun did not turn";
}

RenderSettings with_manifolds(int width, int height, int64_t spp) {
    RenderSettings settings = guided(width, height, spp);
    settings.caustics = CausticStrategy::manifold;
    return settings;
}
RendererOptions with_seeds(bool trained) {
    return {.threads = 2, .planes = {}, .caustics = {.manifold_sampling = true}, .begins_trained = trained};
}
FeatureUse seeds_line(Renderer& renderer) { return feature_line(renderer, "manifold sampling"); }

TEST(KeptSeeds, ImagesAfterTheFirstSampleAreThoseOfAFreshStart) {
    const Stage stage;
    const RenderSettings settings = with_manifolds(80, 48, 4);
    for (const Scene& after : {stage.brighter(), stage.with_sun_turned()}) {
        Renderer untrained(with_seeds(false)), renderer(with_seeds(true));
        edit(untrained, stage.scene, after, settings);
        ASSERT_TRUE(untrained.render(0, 1));
        const Frame first = untrained.resolve();
        EXPECT_FALSE(seeds_line(untrained).used);
        ASSERT_TRUE(untrained.render(1, 3));
        const Frame fresh = untrained.resolve();

        edit(renderer, stage.scene, after, settings);
        ASSERT_TRUE(renderer.render(0, 1));
        EXPECT_FALSE(same_pixels(renderer.resolve(), first)) << "nothing was kept";
        EXPECT_TRUE(seeds_line(renderer).used);
        EXPECT_GT(seeds_line(renderer).bytes.value_or(0), 0);
        EXPECT_TRUE(renderer.info().kernel.ends_with("light paths")) << renderer.info().kernel;
        EXPECT_FALSE(renderer.save_film(0)) << "it depends on the edit";
        ASSERT_TRUE(renderer.render(1, 3));
        EXPECT_TRUE(same_pixels(renderer.resolve(), fresh));
        EXPECT_EQ(seeds_line(renderer).why, seeds_line(untrained).why);
        EXPECT_TRUE(renderer.save_film(0));

        edit(renderer, stage.scene, after, settings);
        ASSERT_TRUE(renderer.render(0, 1));
        ASSERT_TRUE(renderer.settle_first_sample());
        EXPECT_TRUE(same_pixels(renderer.resolve(), first));
        EXPECT_FALSE(renderer.info().kernel.ends_with("light paths")) << renderer.info().kernel;
    }
}

// Where the first sample with seeds would be slow, the session lets the pilots decide before it.
TEST(KeptSeeds, PilotsMayRunBeforeTheFirstSample) {
    const Stage stage;
    const RenderSettings settings = with_manifolds(80, 48, 4);
    Renderer untrained(with_seeds(false)), renderer(with_seeds(true));
    edit(untrained, stage.scene, stage.brighter(), settings);
    ASSERT_TRUE(untrained.render(0, 4));

    edit(renderer, stage.scene, stage.brighter(), settings);
    renderer.set_divider(4);
    ASSERT_TRUE(renderer.render(0, 1));
    EXPECT_TRUE(renderer.begins_with_seeds());
    ASSERT_TRUE(renderer.decide_first_sample());
    EXPECT_FALSE(renderer.begins_with_seeds());
    renderer.set_divider(1);
    ASSERT_TRUE(renderer.render(0, 1));
    const RayCounts rays = renderer.resolve().rays;
    ASSERT_TRUE(renderer.render(1, 1));
    EXPECT_EQ(renderer.resolve().rays.camera, 2 * rays.camera) << "the first sample was rendered again";
    ASSERT_TRUE(renderer.render(2, 2));
    EXPECT_TRUE(same_pixels(renderer.resolve(), untrained.resolve()));
}

// Photons do not depend on the camera: after an edit of it the seeds are those that its own pilot would find.
TEST(KeptSeeds, AfterAnEditOfTheCameraTheFirstSampleIsThatOfThePilots) {
    Stage stage;
    // With one light there is no visibility to learn.
    stage.scene = stage.with_node(stage.lamp, [](Node& n) { n.visible = false; });
    Scene after = stage.scene;
    after.view = looking({1, 2, 5}, {0, 0.5f, 0}, 0.6f);
    const RenderSettings settings = with_manifolds(80, 48, 4);
    RendererOptions options = with_seeds(true);
    options.caustics.light_vertices = false;
    Renderer renderer(options);
    edit(renderer, stage.scene, after, settings);
    ASSERT_TRUE(renderer.render(0, 1));
    ASSERT_TRUE(seeds_line(renderer).used);
    options.begins_trained = false;
    options.is_part = true; // its first sample is rendered as the pilots decide
    Renderer decided(options);
    decided.update(after, settings);
    ASSERT_TRUE(decided.render(0, 1));
    EXPECT_TRUE(same_pixels(renderer.resolve(), decided.resolve()));
}

// A drag: no pilot runs between the edits, and coarse images use the seeds, too.
TEST(KeptSeeds, LastWhileTheSunHasNotTurnedFar) {
    const Stage stage;
    const RenderSettings settings = with_manifolds(80, 48, 4);
    Renderer renderer(with_seeds(true));
    edit(renderer, stage.scene, stage.brighter(), settings);
    const auto used_after = [&](const Scene& scene, int divider) {
        renderer.update(scene, settings);
        renderer.set_divider(divider);
        EXPECT_TRUE(renderer.render(0, 1));
        return seeds_line(renderer).used;
    };
    EXPECT_TRUE(used_after(stage.brighter(), 4));
    EXPECT_TRUE(used_after(stage.scene, 1));
    EXPECT_TRUE(used_after(stage.with_sun_turned(), 4)) << "about half of their use is left";
    EXPECT_TRUE(used_after(stage.scene, 4)) << "and a quarter";
    EXPECT_FALSE(used_after(stage.with_sun_turned(), 4));
    EXPECT_FALSE(used_after(stage.scene, 1)) << "what was dropped stays so";
}

// Seeds of another sun cost walks and no bias. Through a slab of glass, light from direction cosine c arrives (1 - F(c))^2 times
// (manifold_sampling_test.cpp).
TEST(KeptSeeds, OfAnotherSunBiasNothing) {
    constexpr double ior = 1.5;
    Scene before;
    place(before, floor_quad(3), lambert(0.5f));
    Transform slab = at({0, 1, 0});
    slab.scale = {20, 0.1f, 20};
    place(before, cube(false), glass(0, float(ior)), slab);
    Light light;
    light.kind = Light::Kind::sun;
    light.intensity = 4;
    light.angle_radians = 0.0087f;
    const auto at_angle = [](double angle) { return aimed({0, 5, 0}, {float(std::sin(angle)), float(-std::cos(angle)), 0}); };
    const double angle = std::acos(0.8);
    const Id<Node> sun = place_light(before, light, at_angle(angle - 7 * degree));
    before.view = looking({0, 0.5f, 0.8f}, {0, 0, 0}, 0.6f);
    Scene after = before;
    Node turned = *after.nodes.find(sun);
    turned.local = at_angle(angle);
    after.nodes.set(sun, turned);

    RenderSettings settings = with_manifolds(24, 24, 4);
    settings.max_bounces = 3;
    BlockMoments moments;
    Renderer renderer(with_seeds(true));
    for (uint32_t seed = 0; seed < 48; ++seed) {
        settings.seed = seed;
        edit(renderer, before, after, settings);
        ASSERT_TRUE(renderer.render(0, 1));
        ASSERT_TRUE(seeds_line(renderer).used);
        moments.add(image_of(renderer).blocks(24, 24));
    }
    const double c = 0.8, g = std::sqrt(ior * ior - 1 + c * c);
    const double s = (c - g) / (c + g), p = (ior * ior * c - g) / (ior * ior * c + g);
    const double passed = 1 - (s * s + p * p) / 2;
    // The Fresnel term over the sun's disk varies by less than the slack.
    const double expected = 0.5 / std::numbers::pi * 4 * c * passed * passed;
    const Measured kept = moments.measured()[0];
    EXPECT_TRUE(is_mean(kept, expected, statistics::significance, 1e-4 * expected));
    EXPECT_LT(kept.error.x, 0.01 * expected) << "the test sees a bias of a few per cent";
}

} // namespace
} // namespace blush::test::TEST_FILE
