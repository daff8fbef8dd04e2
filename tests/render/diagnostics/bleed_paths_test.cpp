// Batches of the bleed probe: they are the samples of the film, split without a rest, whatever the scene has and however many threads.
#include "core/math.h"
#include "render/diagnostics/bleed_tracer.h"
#include "render/renderer.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

namespace blush::test::TEST_FILE {
namespace {

RenderSettings plain(int width, int height) {
    RenderSettings s = settings_for(width, height, bleed_batch_paths);
    s.caustics = CausticStrategy::off;
    return s;
}

BleedTarget pixel(int x, int y) {
    BleedTarget target;
    target.pixels = {x, y, x + 1, y + 1};
    return target;
}

std::vector<BleedSums> traced(const Scene& scene, const RenderSettings& settings, const BleedTarget& target, int64_t count,
                              unsigned threads = 1) {
    BleedTracer tracer(threads);
    tracer.begin(scene, settings);
    return tracer.trace(target, 0, count);
}

Vec3d sum_of_senders(const BleedSums& s) {
    Vec3d sum{0, 0, 0};
    for (const auto& [sender, flow] : s.senders) sum = sum + flow.light;
    return sum;
}
Vec3d sum_of_lights(const BleedSums& s) {
    Vec3d sum{0, 0, 0};
    for (const auto& [light, rgb] : s.lights) sum = sum + rgb;
    return sum;
}
Vec3d sum_of_bounces(const BleedSums& s) {
    Vec3d sum{0, 0, 0};
    for (const Vec3d& rgb : s.bounces) sum = sum + rgb;
    return sum;
}

void expect_near(const Vec3d& a, const Vec3d& b, double relative) {
    EXPECT_NEAR(a.x, b.x, relative * b.x);
    EXPECT_NEAR(a.y, b.y, relative * b.y);
    EXPECT_NEAR(a.z, b.z, relative * b.z);
}

// Every way in which a stage adds light: suns before a sky, blended sheets before both, a sphere, a mesh that emits, a lamp without a size,
// and a mirror. With `panes`, window glass that glows.
Scene with_all_lights(bool panes) {
    Scene scene;
    place(scene, floor_quad(3), lambert({0.7f, 0.5f, 0.3f}));
    place(scene, cube(false), lambert({0.8f, 0.1f, 0.1f}), at({-1, 0.4f, 0}, 0.4f));
    place(scene, cube(false), metal(0), at({1, 0.4f, 0.2f}, 0.3f));
    place(scene, floor_quad(0.5f, 1.2f), emitter(2, 0.5f));
    Material sheet = lambert({0.2f, 0.9f, 0.2f});
    sheet.alpha = Material::Alpha::blend;
    sheet.opacity = 0.4f;
    sheet.double_sided = true;
    sheet.emissive = {0.05f, 0.1f, 0.05f};
    place(scene, quad({-2, 0.01f, -1.5f}, {2, 0.01f, -1.5f}, {2, 2, -1.5f}, {-2, 2, -1.5f}), sheet);
    if (panes) {
        Material pane = gel({0.9f, 0.9f, 0.5f});
        pane.emissive = {0.1f, 0.1f, 0.3f};
        pane.double_sided = true;
        place(scene, quad({-2, 0.01f, 1}, {2, 0.01f, 1}, {2, 2, 1}, {-2, 2, 1}), pane);
    }
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 2;
    sun.angle_radians = 0.2f;
    place_light(scene, sun, aimed({0, 5, 0}, {0.3f, -1, 0.4f}));
    Light sphere;
    sphere.kind = Light::Kind::sphere;
    sphere.radius = 0.1f;
    sphere.intensity = 10;
    place_light(scene, sphere, at({0.3f, 0.6f, -0.5f}));
    Light point;
    point.intensity = 1;
    place_light(scene, point, at({-0.3f, 0.8f, 0.6f}));
    constant_world(scene, 0.5f);
    scene.view = looking({0.2f, 1.5f, 4}, {0, 0.3f, 0}, 0.8f);
    return scene;
}

TEST(BleedPaths, HaveTheSamplesOfTheFilm) {
    for (const bool panes : {false, true}) {
        const Scene scene = with_all_lights(panes);
        const RenderSettings settings = plain(24, 16);
        Renderer renderer({.threads = 2});
        renderer.update(scene, settings);
        ASSERT_TRUE(renderer.render(0, bleed_batch_paths));
        const Frame frame = renderer.resolve();
        for (const auto& [x, y] : {std::pair{12, 9}, {6, 10}, {17, 10}, {12, 3}, {4, 14}}) {
            const BleedSums sums = traced(scene, settings, pixel(x, y), 1).at(0);
            const float* rgba = &frame.rgba[4 * size_t(y * frame.width + x)];
            EXPECT_GT(rgba[1], 0);
            // Single precision, in another order of lanes.
            expect_near(sum_of_senders(sums), {rgba[0], rgba[1], rgba[2]}, 2e-6);
            expect_near(sum_of_lights(sums), sum_of_senders(sums), 1e-12);
            expect_near(sum_of_bounces(sums), sum_of_senders(sums), 1e-12);
        }
    }
}

// Kinds of senders, and the lights by name.
TEST(BleedPaths, TellSendersAndLightsApart) {
    const Scene scene = with_all_lights(true);
    BleedTracer tracer(1);
    tracer.begin(scene, plain(24, 16));
    BleedTarget target;
    target.pixels = {0, 0, 24, 16};
    std::map<BleedSender, Vec3d> senders;
    std::map<int32_t, Vec3d> lights;
    for (const BleedSums& sums : tracer.trace(target, 0, 16)) {
        for (const auto& [sender, flow] : sums.senders) senders[sender] = senders[sender] + flow.light;
        for (const auto& [light, rgb] : sums.lights) lights[light] = lights[light] + rgb;
    }
    // The sky, the emissive quad, the sheet, three lights and the panes, whose emission is found by light sampling as well.
    EXPECT_EQ(lights.size(), tracer.lights().groups.size() + 1);
    EXPECT_TRUE(lights.contains(glowing_pane));
    for (const SentBy by : {SentBy::itself, SentBy::light, SentBy::object})
        EXPECT_TRUE(std::ranges::any_of(senders, [&](const auto& entry) { return entry.first.by == by; }));
    // Direct light and what is seen directly is that of at most one scattering.
    for (const BleedSums& sums : tracer.trace(target, 16, 2)) {
        Vec3d direct{0, 0, 0};
        for (const auto& [sender, flow] : sums.senders)
            if (sender.by != SentBy::object) direct = direct + flow.light;
        expect_near(direct, sums.bounces[0] + sums.bounces[1], 1e-12);
    }
}

TEST(BleedPaths, DoNotDependOnThreads) {
    const Scene scene = with_all_lights(false);
    BleedTarget target;
    target.pixels = {3, 2, 20, 12};
    const auto one = traced(scene, plain(24, 16), target, 12, 1), three = traced(scene, plain(24, 16), target, 12, 3);
    ASSERT_EQ(one.size(), three.size());
    for (size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(sum_of_senders(one[i]), sum_of_senders(three[i]));
        EXPECT_EQ(one[i].lights, three[i].lights);
        EXPECT_EQ(one[i].bounces, three[i].bounces);
        for (size_t k = 0; k < i; ++k) EXPECT_NE(one[i].bounces, one[k].bounces); // other random numbers
    }
}

// Systematic sampling takes each pixel equally often: the mean is that of the film's pixels.
TEST(BleedPaths, CoverARectangleEvenly) {
    Scene scene;
    constant_world(scene, 1);
    place(scene, quad({-1, -1, 0}, {0, -1, 0}, {0, 1, 0}, {-1, 1, 0}), emitter(5));
    scene.view = looking({0.013f, 0, 4}, {0.013f, 0, 0}, 0.1f);
    const RenderSettings settings = plain(60, 40);
    const RenderedImage image = render(scene, settings);
    BleedTarget target;
    target.pixels = {10, 5, 50, 36};
    double mean = 0;
    const auto batches = traced(scene, settings, target, 256);
    for (const BleedSums& sums : batches) mean += luminance(sum_of_senders(sums)) / double(batches.size());
    EXPECT_NEAR(mean, luminance(image.region(10, 5, 40, 31).mean), 0.005);
}

TEST(BleedPaths, StopWhenUnwanted) {
    BleedTracer tracer(2);
    tracer.begin(with_all_lights(false), plain(24, 16));
    EXPECT_TRUE(tracer.trace(pixel(3, 3), 0, 8, [] { return false; }).empty());
}

// A light mix is applied to the lights, and an edit to the compiled scene.
TEST(BleedPaths, FollowMixAndEdits) {
    Scene scene = with_all_lights(false);
    const RenderSettings settings = plain(24, 16);
    BleedTracer tracer(1);
    tracer.begin(scene, settings);
    const Vec3d before = sum_of_senders(tracer.trace(pixel(12, 12), 0, 1).at(0));
    scene.mix.grouping = LightMix::Grouping::by_light;
    for (const LightGroup& group : tracer.lights().groups) scene.mix.channels.push_back({.group = group.name, .intensity = 2});
    tracer.begin(scene, settings);
    const Vec3d after = sum_of_senders(tracer.trace(pixel(12, 12), 0, 1).at(0));
    EXPECT_NEAR(after.y / before.y, 2, 1e-3);
}

} // namespace
} // namespace blush::test::TEST_FILE
