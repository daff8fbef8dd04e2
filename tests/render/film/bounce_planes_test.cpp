// Bounce planes: they sum to the beauty, hold the right light, and cost nothing if not requested.
#include "core/sampler.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/images.h"

namespace blush::test::TEST_FILE {
namespace {

using statistics::sidak;
using statistics::significance;

Frame render_planes(const Scene& scene, const RenderSettings& settings, int bounces, unsigned threads = 1) {
    Renderer renderer({.threads = threads, .planes = {.bounces = bounces}});
    renderer.update(scene, settings);
    renderer.render(settings.first_sample, settings.spp - settings.first_sample);
    return renderer.resolve();
}

// Every float is rounded once: by at most 2^-24 of itself, in planes and beauty; the rest is double precision.
void expect_same_up_to_rounding(double sum, double whole, const std::string& where) {
    EXPECT_NEAR(sum, whole, std::max(sum, whole) * 0x1.01p-23) << where;
}

double channel(const Vec3& v, int c) { return double(c == 0 ? v.x : c == 1 ? v.y : v.z); }

TEST(BouncePlanes, SumToTheBeauty) {
    for (const std::string& name : shipped_scene_names()) {
        const Scene scene = shipped_scene(name);
        for (const auto& [planes, reuse] : {std::pair{2, 1}, {5, 1}, {5, 16}}) {
            RenderSettings settings = settings_for(24, 16, 8);
            settings.reuse = reuse;
            const Frame frame = render_planes(scene, settings, planes);
            ASSERT_EQ(int(frame.bounces.size()), planes);
            for (size_t i = 0; i < 24 * 16; ++i)
                for (int c = 0; c < 3; ++c) {
                    double sum = 0;
                    for (const auto& plane : frame.bounces) {
                        EXPECT_GE(channel(plane[i], c), 0);
                        sum += channel(plane[i], c);
                    }
                    expect_same_up_to_rounding(sum, double(frame.rgba[4 * i + size_t(c)]), name);
                }
        }
    }
}

// The sum up to plane k equals a render with `--max-bounces k`: the same paths, truncated.
TEST(BouncePlanes, CountScatteringsAsMaxBouncesDoes) {
    for (const char* name : {"cornell", "card-and-mug", "corridor"}) {
        const Scene scene = shipped_scene(name);
        RenderSettings settings = settings_for(24, 16, 4);
        const Frame frame = render_planes(scene, settings, 6);
        for (int k = 0; k < 5; ++k) {
            settings.max_bounces = k;
            const Frame cut = render_planes(scene, settings, 0);
            for (size_t i = 0; i < 24 * 16; ++i) {
                double sum = 0;
                for (int j = 0; j <= k; ++j) sum += channel(frame.bounces[size_t(j)][i], 1);
                expect_same_up_to_rounding(sum, double(cut.rgba[4 * i + 1]), name + std::to_string(k));
            }
        }
    }
}

// In a closed room of emission e and albedo rho, light that was scattered k times is e rho^k.
TEST(BouncePlanes, OfAClosedRoomAreTheGeometricSeries) {
    constexpr double rho = 0.6, glow = 2;
    constexpr int planes = 5;
    Scene scene;
    place(scene, cube(true), emitter(float(glow), float(rho)));
    scene.view = looking({0, 0, 0}, {0, 0, -1}, 1);
    constexpr size_t side = 64, block = 1 << block_bits; // the sampler's blocks are independent, pixels are not
    const Frame frame = render_planes(scene, settings_for(side, side, 16), planes);
    for (int k = 0; k < planes; ++k) {
        const double expected = glow * std::pow(rho, k) / (k + 1 < planes ? 1 : 1 - rho);
        double sums[side / block][side / block] = {};
        for (size_t i = 0; i < side * side; ++i) sums[i / side / block][i % side / block] += double(frame.bounces[size_t(k)][i].y);
        statistics::Moments blocks;
        for (const auto& row : sums)
            for (const double sum : row) blocks.add(sum / (block * block));
        if (k == 0)
            EXPECT_EQ(blocks.mean, expected);
        else
            EXPECT_TRUE(statistics::z_test(blocks, expected, sidak(significance, planes - 1))) << k;
    }
}

TEST(BouncePlanes, TheLastIsTheSumOfFurtherPlanes) {
    const Scene scene = shipped_scene("cornell");
    const RenderSettings settings = settings_for(16, 16, 4);
    const Frame few = render_planes(scene, settings, 3), many = render_planes(scene, settings, 7);
    EXPECT_EQ(few.bounces[0], many.bounces[0]);
    EXPECT_EQ(few.bounces[1], many.bounces[1]);
    for (size_t i = 0; i < 16 * 16; ++i) {
        double rest = 0;
        for (size_t k = 2; k < 7; ++k) rest += channel(many.bounces[k][i], 0);
        expect_same_up_to_rounding(rest, channel(few.bounces[2][i], 0), "rest");
    }
}

TEST(BouncePlanes, DoNotChangeTheBeautyAndAreDeterministic) {
    const Scene scene = shipped_scene("cornell");
    const RenderSettings settings = settings_for(40, 24, 6);
    const Frame without = render_planes(scene, settings, 0), with = render_planes(scene, settings, 4);
    EXPECT_TRUE(without.bounces.empty());
    EXPECT_EQ(without.rgba, with.rgba);
    EXPECT_EQ(render_planes(scene, settings, 4, 3).bounces, with.bounces) << "threads";
    for_each_isa([&](const std::string& isa) { EXPECT_EQ(render_planes(scene, settings, 4).bounces, with.bounces) << isa; });
}

} // namespace
} // namespace blush::test::TEST_FILE
