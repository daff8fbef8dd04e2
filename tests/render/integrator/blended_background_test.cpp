// Path rays see the background behind blended surfaces without noise by chance, and where they stop by chance, the samples of a pixel
// are stratified.
#include "render/renderer.h"
#include "tests/render/integrator/strategy_shots.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <array>
#include <cmath>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

using statistics::sidak;
using statistics::significance;

Material blended(float opacity, float reflectance = 0) {
    Material m = lambert(reflectance);
    m.alpha = Material::Alpha::blend;
    m.opacity = opacity;
    m.double_sided = true;
    return m;
}

RenderSettings direct(int64_t spp) {
    RenderSettings settings = settings_for(24, 24, spp);
    settings.max_bounces = 0;
    return settings;
}

// Black veils in front of the sky. The camera looks in all octants of directions, for each of which Embree traces coherent packets anew.
Scene veils(int count, float opacity, const Vec3& towards) {
    Scene scene;
    constant_world(scene, 2);
    for (int i = 0; i < count; ++i) place(scene, sphere(false), blended(opacity), at({0, 0, 0}, 1 + 0.1f * float(i)));
    scene.view = looking({0, 0, 0}, towards, 2.4f);
    return scene;
}

TEST(BlendedBackground, IsDimmedByTheProductInEachSample) {
    for (const Vec3& towards : {Vec3{0, 0, -1}, Vec3{1, 0.5f, 0.3f}, Vec3{-1, -1, -1}})
        for (const int count : {1, 3, 7}) { // products above 1/16: no Russian roulette
            const RenderedImage image = render(veils(count, 0.3f, towards), direct(2));
            const double expected = 2 * std::pow(1 - double(0.3f), count);
            int off = 0; // a ray along an edge meets both of its triangles
            for (const Vec3d& pixel : image.pixels) off += std::abs(pixel.y / expected - 1) > 1e-5;
            EXPECT_LE(off, 2) << count;
        }
}

TEST(BlendedBackground, HasTheMeanOfAProductThatRouletteEnds) {
    for (const int count : {12, 20})
        EXPECT_TRUE(is_mean(render(veils(count, 0.3f, {0, 0, -1}), direct(1024)).whole(), 2 * std::pow(1 - double(0.3f), count)));
}

TEST(BlendedBackground, IsNotSeenThroughOpaqueSurfaces) {
    Scene scene = veils(3, 0.3f, {0, 0, -1});
    place(scene, quad({-9, -9, -2}, {9, -9, -2}, {9, 9, -2}, {-9, 9, -2}), lambert(0.5f));
    for (const bool near : {false, true}) { // the last one may be met before or after the veils
        if (near) place(scene, quad({-9, -9, -0.5f}, {9, -9, -0.5f}, {9, 9, -0.5f}, {-9, 9, -0.5f}), lambert(0.5f));
        scene.view = looking({0, 0, 0}, {0, 0, -1}, 1);
        for (const Vec3d& pixel : render(scene, direct(4)).pixels) EXPECT_EQ(pixel.y, 0);
    }
}

// Half of the rays stop at the veil, which emits light. Each half of the samples is a (0, 1)-net in the dimension of its triangle, so
// exactly half of them do.
TEST(BlendedBackground, SamplesOfAPixelAreStratified) {
    for (const bool instanced : {false, true}) {
        Scene scene;
        Material lamp = blended(0.5f);
        lamp.emissive = {1, 1, 1};
        lamp.emissive_strength = 3;
        const Id<Node> id = place(scene, quad({-9, -9, -2}, {9, -9, -2}, {9, 9, -2}, {-9, 9, -2}), lamp);
        if (instanced) {
            Node copy = *scene.nodes.find(id);
            copy.local.translation.z = -5; // behind: half of the others
            scene.nodes.add(copy);
        }
        scene.view = looking({0.1f, 0.2f, 0}, {0.1f, 0.2f, -1}, 0.5f);
        RenderSettings settings = direct(16);
        settings.strategy = Strategy::bsdf;
        int off = 0;
        double mean = 0;
        for (const Vec3d& pixel : render(scene, settings).pixels) {
            off += std::abs(pixel.y - 1.5) > 1e-5;
            mean += pixel.y / (24 * 24);
        }
        if (instanced)
            EXPECT_NEAR(mean, 2.25, 0.05);
        else
            EXPECT_LE(off, 24); // pixels on the diagonal between both triangles
    }
}

// Whatever the order in which the traversal meets them.
TEST(BlendedBackground, TheNearestOfTheSurfacesThatStopARayIsHit) {
    for (const bool reversed : {false, true}) {
        Scene scene;
        constant_world(scene, 2);
        for (int i = 0; i < 2; ++i) {
            const bool near = (i == 0) != reversed;
            const float z = near ? -2.f : -4.f;
            Material lamp = blended(0.5f);
            lamp.emissive = {1, 1, 1};
            lamp.emissive_strength = near ? 1.f : 3.f;
            place(scene, quad({-9, -9, z}, {9, -9, z}, {9, 9, z}, {-9, 9, z}), lamp);
        }
        scene.view = looking({0.1f, 0.2f, 0}, {0.1f, 0.2f, -1}, 0.5f);
        EXPECT_TRUE(is_mean(render(scene, direct(64)).whole(), 0.5 * 1 + 0.25 * 3 + 0.25 * 2)) << reversed;
    }
}

// Leaves of many triangles under a sky and a wide sun; some are instances.
Scene leaves() {
    Scene scene;
    constant_world(scene, 1);
    place(scene, floor_quad(4), lambert(0.6f));
    std::mt19937 bits(3);
    const auto random = [&] { return float(bits() >> 8) * 0x1p-24f; };
    for (int i = 0; i < 24; ++i) {
        const Transform where = aimed({2 * random() - 1, 0.3f + random(), 2 * random() - 1}, {random() - 0.5f, random(), random() - 0.5f});
        const Id<Node> id = place(scene, floor_quad(0.3f), blended(0.2f + 0.6f * random(), 0.7f), where);
        if (i % 3) continue;
        Node copy = *scene.nodes.find(id);
        copy.local.translation.y += 0.4f;
        scene.nodes.add(copy);
    }
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 2;
    sun.angle_radians = 0.5f;
    place_light(scene, sun, aimed({0, 5, 0}, {0.3f, -1, 0.2f}));
    scene.view = looking({0, 1.2f, 3.5f}, {0, 0.5f, 0}, 0.8f);
    return scene;
}

TEST(BlendedBackground, StrategiesAgree) {
    const Scene scene = leaves();
    const auto found = shot(scene, Strategy::bsdf, 1024);
    const double each = sidak(significance, 3);
    EXPECT_TRUE(same_means(shot(scene, Strategy::light, 512), found, each));
    EXPECT_TRUE(same_means(shot(scene, Strategy::mis, 512), found, each));
    EXPECT_TRUE(same_means(shot(scene, Strategy::mis, 512, 16), found, each));
}

// Groups of the sun, the sky and lamps that are leaves.
TEST(BlendedBackground, LightGroupsAddUpToTheImage) {
    Scene scene = leaves();
    Material lamp = blended(0.5f, 0.5f);
    lamp.emissive = {1, 0.5f, 0.2f};
    place(scene, floor_quad(0.5f, 0.9f), lamp);
    scene.mix.grouping = LightMix::Grouping::by_light;
    RenderSettings settings = settings_for(32, 32, 8);
    settings.max_bounces = 2;
    Renderer renderer({.threads = 2});
    renderer.update(scene, settings);
    EXPECT_TRUE(renderer.render(0, 8));
    const Frame frame = renderer.resolve();
    ASSERT_GE(frame.groups.size(), 3u);
    for (size_t i = 0; i < frame.groups[0].size(); ++i) {
        Vec3 sum{0, 0, 0};
        for (const auto& group : frame.groups) sum = sum + group[i];
        EXPECT_NEAR(sum.x, frame.rgba[4 * i], 2e-5f * (1 + sum.x)) << i;
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
