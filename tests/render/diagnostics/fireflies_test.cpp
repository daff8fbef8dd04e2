// Fireflies: the worst samples are found, in an order that depends on the image only, and can be traced again.
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <cstdio>

namespace blush::test::TEST_FILE {
namespace {

RenderSettings settings() { return settings_for(48, 32, 16); }

// Samples [0, 16) in batches of the given size.
Health health_of(const Scene& scene, unsigned threads, int64_t batch) {
    Renderer renderer({.threads = threads, .planes = {}});
    renderer.update(scene, settings());
    for (int64_t first = 0; first < 16; first += batch) renderer.render(first, batch);
    return renderer.resolve().health;
}

TEST(Fireflies, DoNotDependOnThreadsOrBatches) {
    const Scene scene = shipped_scene("card-and-mug");
    const Health one = health_of(scene, 1, 16);
    EXPECT_EQ(one.fireflies.size(), 100u);
    EXPECT_EQ(one.fireflies, health_of(scene, 3, 16).fireflies);
    EXPECT_EQ(one.fireflies, health_of(scene, 1, 1).fireflies);
    EXPECT_EQ(one.fireflies, health_of(scene, 2, 4).fireflies);
}

// Compared with all samples of the image, one by one.
TEST(Fireflies, AreTheWorstOfAllSamples) {
    const Scene scene = shipped_scene("card-and-mug");
    Renderer renderer({.threads = 1, .planes = {}});
    renderer.update(scene, settings());
    std::vector<double> sums(48 * 32), excesses;
    for (int64_t s = 0; s < 16; ++s) {
        renderer.clear();
        renderer.render(s, 1);
        const Frame frame = renderer.resolve();
        for (size_t i = 0; i < sums.size(); ++i) {
            const float* c = &frame.rgba[4 * i];
            const double bright = 0.212671 * double(c[0]) + 0.715160 * double(c[1]) + 0.072169 * double(c[2]);
            sums[i] += bright;
            const double mean = sums[i] / double(s + 1);
            excesses.push_back(bright / std::sqrt(mean * mean + 0.01));
        }
    }
    std::sort(excesses.begin(), excesses.end(), std::greater());
    const Health health = health_of(scene, 1, 16);
    ASSERT_EQ(health.fireflies.size(), 100u);
    for (size_t i = 0; i < 100; ++i) EXPECT_NEAR(double(health.fireflies[i].excess), excesses[i], 1e-5 * excesses[i]) << i;
}

TEST(Fireflies, CanBeTracedAgain) {
    const Scene scene = shipped_scene("card-and-mug");
    const Health health = health_of(scene, 1, 16);
    for (size_t i = 0; i < 5; ++i) {
        const Firefly& f = health.fireflies[i];
        const std::string log = trace_sample(scene, settings(), f.x, f.y, f.sample);
        Vec3 c{0, 0, 0};
        ASSERT_EQ(std::sscanf(log.c_str() + log.rfind("radiance ("), "radiance (%f, %f, %f)", &c.x, &c.y, &c.z), 3) << log;
        EXPECT_NEAR(0.212671f * c.x + 0.715160f * c.y + 0.072169f * c.z, f.luminance, 1e-5f * f.luminance);
    }
}

TEST(Fireflies, AreAbsentFromAnImageWithoutNoise) {
    Scene scene;
    constant_world(scene, 3);
    scene.view = looking_down(1, 1);
    EXPECT_TRUE(health_of(scene, 1, 16).fireflies.empty());
}

} // namespace
} // namespace blush::test::TEST_FILE
