// Texture filtering in images: distant textures show their mean, and near ones do not change.
#include "core/srgb.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <gtest/gtest.h>

namespace blush::test::TEST_FILE {
namespace {

constexpr Vec3 bright{0.9f, 0.3f, 0.1f}, dark{0.1f, 0.5f, 0.8f}; // encoded

Vec3d mean_of_checks() {
    const auto mean = [](float a, float b) { return 0.5 * (linear_from_srgb(double(a)) + linear_from_srgb(double(b))); };
    return {mean(bright.x, dark.x), mean(bright.y, dark.y), mean(bright.z, dark.z)};
}

// Squares of one metre on [-half, half]^2, with 8 x 8 texels each.
Material checkered(Scene& scene, Material material, float half) {
    std::vector<Vec3> texels;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) texels.push_back((x / 8 + y / 8) % 2 ? bright : dark);
    TextureRef& ref = material.base_color_texture;
    ref.texture = add_texture(scene, float_image(64, 64, texels), Texture::Filter::linear);
    ref.scale = {half / 4, half / 4}; // eight squares are one image
    return material;
}

// An unlit plane to the horizon, seen from 50 m above along -Z; the horizon is in the middle of the image.
Scene plain() {
    Scene scene;
    place(scene, floor_quad(1e5f), checkered(scene, unlit({1, 1, 1}), 1e5f));
    scene.view.position = {0.3f, 50, 0.2f};
    scene.view.lens.yfov_radians = 0.7f;
    return scene;
}

constexpr int width = 96, height = 64;
RenderedImage draw(const Scene& scene, bool filter, int64_t spp) {
    Renderer renderer({.threads = 1, .planes = {}, .filter_textures = filter});
    renderer.update(scene, settings_for(width, height, spp));
    renderer.render(0, spp);
    return image_of(renderer);
}

double variance(const Measured& m) { return m.error.x * m.error.x + m.error.y * m.error.y + m.error.z * m.error.z; }

TEST(TextureFilter, APlaneToTheHorizonShowsItsMeanWithoutNoise) {
    const Scene scene = plain();
    const RenderedImage filtered = draw(scene, true, 64), points = draw(scene, false, 64);
    // Six rows below the horizon: 700 m away and more, where half a pixel is four squares.
    const Measured far_filtered = filtered.region(0, height / 2 + 1, width, 5), far_points = points.region(0, height / 2 + 1, width, 5);
    EXPECT_TRUE(is_mean(far_filtered, mean_of_checks()));
    EXPECT_TRUE(is_mean(far_points, mean_of_checks()));
    EXPECT_LT(variance(far_filtered), variance(far_points) / 100);
    // Nearer, where squares are visible, filtering moves light by less than a pixel.
    const Measured near_filtered = filtered.region(0, height / 2 + 8, width, 24), near_points = points.region(0, height / 2 + 8, width, 24);
    EXPECT_TRUE(same_mean(near_filtered, near_points));
    RecordProperty("variance_ratio_near", std::to_string(variance(near_points) / variance(near_filtered)));
}

TEST(TextureFilter, MagnifiedTexturesDoNotChangeByABit) {
    Scene scene;
    place(scene, floor_quad(8), checkered(scene, unlit({1, 1, 1}), 8));
    scene.view = looking({0.3f, 1, 0.2f}, {0.31f, 0, 0.2f}, 0.7f);
    EXPECT_EQ(draw(scene, true, 4).pixels, draw(scene, false, 4).pixels);
}

TEST(TextureFilter, LitScenesKeepTheirLight) {
    Scene scene;
    place(scene, floor_quad(8), checkered(scene, lambert(1), 8));
    place(scene, cube(false), checkered(scene, plastic(0.3f), 8), at({0.5f, 1, -0.5f}));
    constant_world(scene, 1);
    scene.view = looking({2, 6, 14}, {0, 0, 0}, 0.7f);
    EXPECT_TRUE(same_mean(draw(scene, true, 64).whole(), draw(scene, false, 64).whole()));
}

// The plane behind the camera, seen in a mirror in front of it.
Scene mirrored(bool curved) {
    Scene scene = plain();
    Geometry g = *quad({-90, -40, -1}, {90, -40, -1}, {90, 140, -1}, {-90, 140, -1});
    g.serial = next_payload_serial();
    if (curved) g.normals = {unit({-0.001f, 0, 1}), unit({0.001f, 0, 1}), unit({0.001f, 0, 1}), unit({-0.001f, 0, 1})};
    place(scene, std::make_shared<const Geometry>(g), metal(0));
    return scene;
}

TEST(TextureFilter, WorksBehindFlatMirrorsOnly) {
    const Scene flat = mirrored(false), curved = mirrored(true);
    const auto far_part = [](const RenderedImage& p) { return p.region(0, height / 2 + 1, width, 5); };
    const Measured filtered = far_part(draw(flat, true, 16)), points = far_part(draw(flat, false, 16));
    EXPECT_TRUE(is_mean(filtered, mean_of_checks()));
    EXPECT_LT(variance(filtered), variance(points) / 100);
    EXPECT_EQ(draw(curved, true, 4).pixels, draw(curved, false, 4).pixels);
}

} // namespace
} // namespace blush::test::TEST_FILE
