// The four Cornell boxes of SmallVCM (Davidovic and Georgiev, https://github.com/SmallVCM/SmallVCM, scene.hxx and config.hxx), built from
// their dimensions: balls of mirror and glass on a glossy floor, under a sun, a ceiling lamp, a point light and a sky. All strategies
// agree.
#include "tests/render/integrator/caustic_images.h"
#include "tests/support/statistics.h"

#include <string>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

// SmallVCM's z is up. The walls, and so the box, are not quite centred.
Vec3 placed(float x, float y, float z) { return {x, z, -y}; }
constexpr float left = -1.27029f, right = 1.28975f, front = -1.25549f, back = 1.30455f, bottom = -1.28002f, top = 1.28002f;

Scene box() {
    const auto corner = [](float x, float y, float z) { return placed(x, y, z); };
    Scene scene;
    // Diffuse 0.1 and glossy 0.7, with a Phong exponent of 90: alpha = sqrt(2 / 92).
    Material floor = metal(0.384f);
    floor.base_color = {0.8f, 0.8f, 0.8f};
    floor.metallic = 0.875f;
    floor.specular = 0;
    const Vec3 green{0.156863f, 0.803922f, 0.172549f}, red{0.803922f, 0.152941f, 0.152941f}, blue{0.156863f, 0.172549f, 0.803922f};
    const Vec3 a = corner(left, front, bottom), b = corner(right, front, bottom), c = corner(right, back, bottom),
               d = corner(left, back, bottom);
    const Vec3 e = corner(left, front, top), f = corner(right, front, top), g = corner(right, back, top), h = corner(left, back, top);
    place(scene, quad(a, b, c, d), floor);
    place(scene, quad(d, c, g, h), lambert(blue));
    place(scene, quad(e, h, g, f), lambert(0.803922f));
    place(scene, quad(a, d, h, e), lambert(green));
    place(scene, quad(c, b, f, g), lambert(red));
    scene.view = looking(placed(-0.0439815f, -4.12529f, 0.222539f), placed(-0.0370953f, -3.126785f, 0.168323f), 0.785f);
    return scene;
}
void add_ball(Scene& scene, float x, float radius, const Material& material) {
    place(scene, sphere(false), material, at(placed(x, (front + back) / 2, bottom + radius), radius));
}
void add_small_balls(Scene& scene) {
    const float apart = right - left;
    add_ball(scene, left + 2 * apart / 7, 0.5f, metal(0));
    add_ball(scene, right - 2 * apart / 7, 0.5f, glass(0, 1.6f));
}

// The sun and the point of the original have no size. No ray hits such lights: a size makes all strategies complete.
Scene sun_and_small_balls(float angle) {
    Scene scene = box();
    add_small_balls(scene);
    Light sun = caustic_light(Light::Kind::sun, 10);
    sun.color = {1, 0.4f, 0};
    sun.angle_radians = angle;
    place_light(scene, sun, aimed({0, 0, 0}, placed(-1, 1.5f, -1)));
    return scene;
}
Scene point_and_small_balls(float radius) {
    Scene scene = box();
    add_small_balls(scene);
    place_light(scene, caustic_light(Light::Kind::point, 70 / (4 * pi), radius), at(placed(0, -0.5f, 1)));
    return scene;
}
Scene ceiling_and_large_mirror() {
    Scene scene = box();
    add_ball(scene, (left + right) / 2, 0.8f, metal(0));
    place(scene, ceiling_quad(0.25f, 1.26002f), emitter(25.0333f));
    return scene;
}
Scene sky_and_small_balls() {
    Scene scene = box();
    add_small_balls(scene);
    constant_world(scene, 1);
    scene.environment.color = {135 / 255.f, 206 / 255.f, 250 / 255.f};
    return scene;
}

using Way = std::pair<CausticStrategy, CausticOptions>;
const Way off{CausticStrategy::off, {}}, guiding{CausticStrategy::guiding, {}}, automatic{CausticStrategy::automatic, {}},
    light_paths{CausticStrategy::light_paths, {.light_path_share = 1.f, .manifold_sampling = false}},
    manifold{CausticStrategy::manifold, {.light_path_share = 0.f, .manifold_sampling = true}};

// Means over 30 independent images each: of fewer they are not normal, as mirrors and glass make rare bright samples.
testing::AssertionResult ways_agree(const Scene& scene, const std::vector<Way>& ways) {
    std::vector<std::vector<Measured>> seen;
    uint32_t seed = 1;
    for (const auto& [caustics, options] : ways) {
        RenderSettings settings = settings_for(24, 24, 32);
        settings.caustics = caustics;
        settings.max_bounces = 5;
        seen.push_back(image_blocks(scene, settings, options, 30, seed += 1000, [](Renderer&) {}));
    }
    const auto pairs = int64_t(ways.size() * (ways.size() - 1) / 2);
    for (size_t i = 0; i < seen.size(); ++i)
        for (size_t k = 0; k < i; ++k)
            if (auto verdict = same_means(seen[i], seen[k], sidak(significance, pairs)); !verdict)
                return verdict << ", " << to_string(ways[i].first) << " and " << to_string(ways[k].first);
    return testing::AssertionSuccess();
}

testing::AssertionResult strategies_agree(const Scene& scene) {
    return ways_agree(scene, {off, guiding, light_paths, manifold, automatic});
}

TEST(CornellCaustics, StrategiesAgreeInTheSun) { EXPECT_TRUE(strategies_agree(sun_and_small_balls(0.5f))); }
TEST(CornellCaustics, StrategiesAgreeUnderTheCeilingLamp) { EXPECT_TRUE(strategies_agree(ceiling_and_large_mirror())); }
TEST(CornellCaustics, StrategiesAgreeUnderAPoint) { EXPECT_TRUE(strategies_agree(point_and_small_balls(0.2f))); }
TEST(CornellCaustics, StrategiesAgreeUnderTheSky) { EXPECT_TRUE(strategies_agree(sky_and_small_balls())); }
TEST(CornellCaustics, OfLightsWithoutSizeAreNotFoundByHits) {
    for (const Scene& scene : {sun_and_small_balls(0), point_and_small_balls(0)}) {
        EXPECT_TRUE(ways_agree(scene, {off, guiding}));
        for (const Way& finds : {light_paths, manifold, automatic}) EXPECT_FALSE(ways_agree(scene, {off, finds})) << to_string(finds.first);
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
