// Invalid inputs: unusable values are dropped, counted and reported, and the image stays finite.
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

namespace blush::test::TEST_FILE {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();

Frame render_anything(const Scene& scene, int64_t spp = 4) {
    Renderer renderer({.threads = 1, .planes = {true, true, true, true}});
    renderer.update(scene, settings_for(16, 16, spp));
    renderer.render(0, spp);
    return renderer.resolve();
}
void expect_finite(const Frame& frame) {
    for (const float value : frame.rgba) ASSERT_TRUE(std::isfinite(value) && value >= 0);
    for (const Vec3& v : frame.albedo) ASSERT_TRUE(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
    for (const Vec3& v : frame.normal) ASSERT_TRUE(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
}

TEST(Health, OverflowingSamplesAreDroppedCountedAndRecorded) {
    const Scene scene = floor_under_an_overflowing_bulb();
    const Frame frame = render_anything(scene);
    expect_finite(frame);
    EXPECT_GT(frame.health.infinite, 0);
    EXPECT_LT(frame.health.dropped(), 16 * 16 * 4);
    ASSERT_FALSE(frame.health.first.empty());
    for (const BadSample& bad : frame.health.first) {
        EXPECT_EQ(bad.cause, BadSample::Cause::infinite);
        EXPECT_LT(std::hypot(bad.x - 7.5, bad.y - 7.5), 8) << "far from the light";
        EXPECT_GE(bad.sample, 0);
        EXPECT_LT(bad.sample, 4);
        // Replay: the same sample alone is bad again.
        const std::string log = trace_sample(scene, settings_for(16, 16, 4), bad.x, bad.y, bad.sample);
        EXPECT_NE(log.find("inf"), std::string::npos) << log;
    }
}

TEST(Health, NonFiniteTexelsDoNotSpread) {
    for (const float bad : {nan, inf, -inf, -3.f}) {
        const ImagePtr image =
            float_image(2, 2, std::vector<Vec3>{{bad, bad, bad}, {0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.5f}});
        Scene colored, emitting, world;
        Material material = lambert(1);
        material.base_color_texture.texture = add_texture(colored, image);
        place(colored, floor_quad(1), material);
        constant_world(colored, 1);
        material = emitter(1);
        material.emissive_texture.texture = add_texture(emitting, image);
        place(emitting, floor_quad(1), material);
        place(world, floor_quad(1), lambert(0.5f));
        world.environment.kind = Environment::Kind::image;
        world.environment.image = image;
        for (Scene* scene : {&colored, &emitting, &world}) {
            scene->view = looking_down(1, 1);
            const Frame frame = render_anything(*scene);
            expect_finite(frame);
            EXPECT_EQ(frame.health.dropped(), 0) << "sanitised, not dropped";
            // The valid texels are unchanged: the last quarter of the floor, the sky.
            EXPECT_GT(frame.rgba[4 * (12 * 16 + 12)], 0);
        }
    }
}

TEST(Health, NonFiniteMaterialsAndGeometryDoNotSpread) {
    Scene scene;
    Material m = plastic(nan);
    m.base_color = {nan, inf, -1};
    m.ior = -inf;
    m.emissive = {nan, -1, 1};
    m.emissive_strength = inf;
    m.normal_scale = nan;
    place(scene, floor_quad(0.5f), m);
    Geometry broken = *floor_quad(0.5f, 0.2f);
    broken.serial = next_payload_serial();
    broken.positions[0] = {nan, 0, inf};
    broken.normals.assign(4, {nan, 0, 0});
    place(scene, std::make_shared<const Geometry>(broken), lambert(0.5f));
    place(scene, quad({0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}), emitter(5));
    Transform nowhere;
    nowhere.translation = {nan, 0, 0};
    place(scene, floor_quad(1), lambert(0.5f), nowhere);
    place(scene, floor_quad(1), lambert(0.5f), at({0, 0, 0}, 0));
    constant_world(scene, 1);
    scene.view = looking_down(1, 1);
    const Frame frame = render_anything(scene);
    expect_finite(frame);
    // The environment is still visible around them.
    EXPECT_EQ(frame.rgba[0], 1);
}

TEST(Health, AnEmptySceneIsBlack) {
    for (const float value : render_anything({}).rgba) EXPECT_TRUE(value == 0 || value == 1);
    Scene lit;
    place_light(lit, Light{}, at({0, 1, 0}));
    EXPECT_EQ(render_anything(lit).rgba[0], 0);
}

} // namespace
} // namespace blush::test::TEST_FILE
