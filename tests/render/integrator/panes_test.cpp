// Panes (thin smooth transmissive walls): light passes straight through, for every kind of light and every strategy
// (render/integrator/thin_transmission.h).
#include "tests/render/irradiance.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <cmath>
#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

using statistics::sidak;
using statistics::significance;

// Appendix B: the tint times 1 - F, F Schlick's from 0.04.
double passes(double cosine, double tint = 1) { return tint * (1 - (0.04 + 0.96 * std::pow(1 - cosine, 5))); }

constexpr float albedo = 0.6f;

// A diffuse floor under `panes` parallel panes, seen from between them.
Scene floor_under_panes(int panes, const Material& material) {
    Scene scene;
    place(scene, floor_quad(50), lambert(albedo));
    for (int i = 0; i < panes; ++i) place(scene, floor_quad(50, 1 + 0.1f * float(i)), material);
    scene.view = looking_down(0.5f, 0.5f);
    return scene;
}
// Single scattering only: light that panes reflect back to the floor is excluded.
Vec3d direct_light(const Scene& scene, Strategy strategy = Strategy::mis, int64_t spp = 4) {
    RenderSettings settings = settings_for(4, 4, spp);
    settings.max_bounces = 1;
    settings.strategy = strategy;
    return render(scene, settings).whole().mean;
}

void sunlit(Scene& scene, const Vec3& direction) {
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 10;
    place_light(scene, sun, aimed({0, 5, 0}, direction));
}

// Without noise: a single light, sampled once, and no other contribution.
TEST(Panes, PassAParallelSunExactly) {
    for (const int panes : {0, 1, 2, 30}) {
        for (const Vec3& direction : {Vec3{0, -1, 0}, Vec3{1, -1, 0}, Vec3{0.9f, -0.2f, 0.1f}}) {
            Scene scene = floor_under_panes(panes, window_glass({0.9f, 0.8f, 0.7f}));
            sunlit(scene, direction);
            const double cosine = -double(unit(direction).y), lit = albedo / std::numbers::pi * 10 * cosine;
            const Vec3d expected{lit * std::pow(passes(cosine, 0.9f), panes), lit * std::pow(passes(cosine, 0.8f), panes),
                                 lit * std::pow(passes(cosine, 0.7f), panes)};
            for (const Strategy strategy : {Strategy::mis, Strategy::light, Strategy::bsdf}) {
                const Vec3d seen = direct_light(scene, strategy);
                EXPECT_NEAR(seen.x, expected.x, 1e-4 * expected.x) << panes;
                EXPECT_NEAR(seen.y, expected.y, 1e-4 * expected.y) << panes;
                EXPECT_NEAR(seen.z, expected.z, 1e-4 * expected.z) << panes;
            }
        }
    }
}

TEST(Panes, PassPointsAndSpotsExactly) {
    for (const Light::Kind kind : {Light::Kind::point, Light::Kind::spot}) {
        Light light;
        light.kind = kind;
        light.intensity = 7;
        Scene open = floor_under_panes(0, {}), closed = floor_under_panes(1, gel({0.5f, 0.25f, 0.125f}));
        for (Scene* scene : {&open, &closed}) place_light(*scene, light, aimed({0.1f, 2, 0.2f}, {0, -1, 0}));
        const Vec3d direct = direct_light(open), through = direct_light(closed);
        ASSERT_GT(direct.y, 0);
        EXPECT_NEAR(through.x, 0.5 * direct.x, 1e-5 * direct.x);
        EXPECT_NEAR(through.y, 0.25 * direct.y, 1e-5 * direct.y);
        EXPECT_NEAR(through.z, 0.125 * direct.z, 1e-5 * direct.z);
    }
}

// Rough or solid glass bends light: nothing passes straight through.
TEST(Panes, OnlyThinSmoothOnesPassZeroSizeLights) {
    Material rough = window_glass(), solid = window_glass();
    rough.roughness = 0.3f;
    solid.thickness = 0.01f;
    for (const Material& material : {rough, solid}) {
        Scene scene = floor_under_panes(1, material);
        sunlit(scene, {0, -1, 0});
        EXPECT_EQ(direct_light(scene).y, 0);
    }
}

TEST(Panes, AttenuateTransmittedLight) {
    Scene scene;
    place(scene, floor_quad(50), emitter(3));
    for (const float y : {0.1f, 0.2f}) place(scene, floor_quad(50, y), window_glass({0.5f, 1, 1}));
    scene.view = looking_down(0.5f, 0.5f);
    // Light is reflected back and forth between the panes; the floor reflects nothing.
    const double t = passes(1, 0.5), r = 0.04;
    const Measured seen = render(scene, settings_for(8, 8, 1024)).whole();
    EXPECT_TRUE(is_mean(seen, Vec3d{3 * t * t / (1 - r * r), 3 * 0.96 * 0.96 / (1 - r * r), 3 * 0.96 * 0.96 / (1 - r * r)}));
}

// A room behind glass, with panes of all kinds, under a light of one kind.
Scene glazed_room(Light::Kind kind) {
    Scene scene;
    place(scene, floor_quad(3), lambert(0.7f));
    place(scene, ceiling_quad(3, 3), lambert({0.3f, 0.6f, 0.9f}));
    Material half = window_glass({0.9f, 0.7f, 0.8f}); // of light that does not pass, some is scattered
    half.transmission = 0.5f;
    place(scene, floor_quad(1.5f, 1), half, at({-1, 0, 0}));
    place(scene, floor_quad(1.5f, 1.4f), window_glass({0.8f, 0.9f, 0.5f}), at({1, 0, 0}));
    Material glowing = window_glass();
    glowing.emissive = {0.2f, 0.1f, 0.05f};
    glowing.double_sided = true;
    place(scene, floor_quad(0.6f, 0.5f), glowing, at({0.5f, 0, 1}));
    Light light;
    light.kind = kind;
    light.intensity = kind == Light::Kind::sun ? 2.f : 5.f;
    light.radius = 0.4f;
    light.angle_radians = 0.6f;
    light.width = light.height = 0.8f;
    light.visible_to_camera = false; // its edge, sampled rarely, would dominate the variance
    if (kind == Light::Kind::sun)
        place_light(scene, light, aimed({0, 2.5f, 0}, {0.8f, -0.5f, 0.1f}));
    else
        place_light(scene, light, aimed({0, 2.5f, 0}, {0.2f, -1, 0.1f}));
    scene.view = looking({0, 2.2f, 4}, {0, 0.8f, 0}, 0.8f);
    return scene;
}
std::vector<Measured> shot(const Scene& scene, Strategy strategy, int64_t spp, int reuse = 1, int max_bounces = unlimited_bounces) {
    RenderSettings settings = settings_for(32, 32, spp);
    settings.strategy = strategy;
    settings.reuse = reuse;
    settings.max_bounces = max_bounces;
    settings.seed = 1 + uint32_t(strategy) + uint32_t(reuse);
    return render(scene, settings).blocks(16, 16);
}

TEST(Panes, AreTheSameForEveryStrategy) {
    const double each = sidak(significance, 5 * 3);
    for (const Light::Kind kind : {Light::Kind::rectangle, Light::Kind::disk, Light::Kind::sphere, Light::Kind::sun, Light::Kind::point}) {
        const Scene scene = glazed_room(kind);
        const auto mis = shot(scene, Strategy::mis, 256);
        EXPECT_TRUE(same_means(mis, shot(scene, Strategy::light, 256), each)) << "light " << int(kind);
        EXPECT_TRUE(same_means(mis, shot(scene, Strategy::bsdf, 1024), each)) << "bsdf " << int(kind);
        EXPECT_TRUE(same_means(mis, shot(scene, Strategy::mis, 256, 8), each)) << "path reuse " << int(kind);
    }
}

// Panes are no scattering events: a bounce limit cuts the same light for every strategy.
TEST(Panes, DoNotCountAsBounces) {
    const Scene scene = glazed_room(Light::Kind::rectangle);
    for (const int bounces : {1, 2}) {
        const auto mis = shot(scene, Strategy::mis, 256, 1, bounces);
        EXPECT_TRUE(same_means(mis, shot(scene, Strategy::light, 256, 1, bounces), sidak(significance, 4))) << bounces;
        EXPECT_TRUE(same_means(mis, shot(scene, Strategy::bsdf, 1024, 1, bounces), sidak(significance, 4))) << bounces;
    }
}

// First-hit data of every pixel are those of the pane, whether its samples pass or not.
TEST(Panes, AreShownByFirstHitPlanes) {
    Scene scene = floor_under_panes(0, {});
    const Id<Node> pane = place(scene, floor_quad(50, 0.25f), window_glass());
    sunlit(scene, {0.2f, -1, 0});
    const RenderedImage image = render(scene, settings_for(8, 8, 16), {.normal = true, .depth = true, .ids = true});
    for (size_t i = 0; i < image.frame.object_id.size(); ++i) {
        EXPECT_EQ(image.frame.object_id[i], pane.value);
        EXPECT_NEAR(image.frame.depth[i], 0.25f, 1e-5f);
        EXPECT_NEAR(image.frame.normal[i].y, 1, 1e-5f);
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
