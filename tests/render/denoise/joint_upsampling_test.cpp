#include "render/denoise/joint_upsampling.h"

#include "core/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace blush::TEST_FILE {
namespace {

struct Hit {
    Vec3 albedo{0.5f, 0.5f, 0.5f}, normal{0, 0, 1};
    float depth = 1;
};
// What is seen at (u, v) in [0, 1].
using Seen = std::function<Hit(float u, float v)>;

struct Image {
    Image(int w, int h, const Seen& seen) : width(w), height(h) {
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                const Hit hit = seen((float(x) + 0.5f) / float(w), (float(y) + 0.5f) / float(h));
                albedo.push_back(hit.albedo);
                normal.push_back(hit.normal);
                depth.push_back(hit.depth);
            }
    }
    FirstHitPlanes planes() const { return {width, height, albedo, normal, depth, {}}; }

    int width, height;
    std::vector<Vec3> albedo, normal;
    std::vector<float> depth;
};

// Radiance of the coarse image: albedo times `light` of each pixel.
std::vector<float> lit(const Image& image, const std::function<float(size_t pixel)>& light) {
    std::vector<float> rgb;
    for (size_t i = 0; i < image.albedo.size(); ++i)
        for (const float a : {image.albedo[i].x, image.albedo[i].y, image.albedo[i].z}) rgb.push_back(a * light(i));
    return rgb;
}

TEST(JointUpsampling, TexturesAreThoseOfTheFineImage) {
    const auto stripes = [](float u, float) {
        const float a = int(u * 40) % 2 == 0 ? 0.2f : 0.7f;
        return Hit{.albedo = {a, a / 2, a / 4}};
    };
    const Image coarse(20, 10, [](float, float) { return Hit{}; }), fine(120, 60, stripes);
    const std::vector<float> rgb = upsample_jointly(lit(coarse, [](size_t) { return 2.f; }), coarse.planes(), fine.planes());
    ASSERT_EQ(rgb.size(), size_t(3 * 120 * 60));
    // Irradiance is the coarse image's radiance over its albedo, each with the albedo that is added to all.
    const float irradiance = 2 * 0.5f / 0.52f;
    for (size_t i = 0; i < fine.albedo.size(); ++i) {
        ASSERT_NEAR(rgb[3 * i], irradiance * (fine.albedo[i].x + 0.02f), 1e-5f) << i;
        ASSERT_NEAR(rgb[3 * i + 2], irradiance * (fine.albedo[i].z + 0.02f), 1e-5f) << i;
    }
}

// Two surfaces with light 1 and 10. Between them is an edge that no coarse pixel border meets.
void expect_sharp_edge(const Hit& left, const Hit& right) {
    const auto seen = [&](float u, float) { return u < 0.53f ? left : right; };
    const Image coarse(20, 12, seen), fine(120, 72, seen);
    const auto is_left = [&](const Image& image, size_t i) { return (float(i % size_t(image.width)) + 0.5f) / float(image.width) < 0.53f; };
    const std::vector<float> rgb =
        upsample_jointly(lit(coarse, [&](size_t i) { return is_left(coarse, i) ? 1.f : 10.f; }), coarse.planes(), fine.planes());
    for (size_t i = 0; i < fine.albedo.size(); ++i) {
        const float expected = fine.albedo[i].x * (is_left(fine, i) ? 1.f : 10.f);
        ASSERT_NEAR(rgb[3 * i], expected, 0.1f * expected) << i % 120;
    }
}

TEST(JointUpsampling, LightStaysOnItsSideOfAnEdge) {
    const Hit wall{.albedo = {0.8f, 0.8f, 0.8f}};
    Hit turned = wall, behind = wall, red = wall;
    turned.normal = {1, 0, 0};
    behind.depth = 3;
    red.albedo = {0.6f, 0.05f, 0.05f};
    expect_sharp_edge(wall, turned);
    expect_sharp_edge(wall, behind);
    expect_sharp_edge(wall, red);
    Hit nothing{.albedo = {0.8f, 0.8f, 0.8f}, .normal = {0, 0, 0}, .depth = 0};
    expect_sharp_edge(wall, nothing);
}

TEST(JointUpsampling, SmoothLightIsInterpolated) {
    const Image coarse(16, 8, [](float, float) { return Hit{}; }), fine(80, 40, [](float, float) { return Hit{}; });
    const std::vector<float> rgb =
        upsample_jointly(lit(coarse, [](size_t i) { return float(i % 16) + 0.5f; }), coarse.planes(), fine.planes());
    for (int x = 5; x < 75; ++x) {
        const float place = (float(x) + 0.5f) / 5, value = rgb[size_t(3 * (20 * 80 + x))] / 0.5f;
        // The share of pixels far away draws it to the middle of two pixels.
        EXPECT_NEAR(value, place, 0.03f) << x;
    }
}

TEST(JointUpsampling, DoesNotDependOnThreads) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> any(0, 1);
    const auto noise = [&](float, float) {
        return Hit{{any(random), any(random), any(random)}, {any(random), any(random), any(random)}, any(random)};
    };
    const Image coarse(37, 23, noise), fine(211, 140, noise);
    const std::vector<float> rgb = lit(coarse, [&](size_t) { return 5 * any(random); });
    const std::vector<float> alone = upsample_jointly(rgb, coarse.planes(), fine.planes());
    for (const unsigned threads : {1u, 3u}) {
        const Workers workers(threads);
        EXPECT_EQ(upsample_jointly(rgb, coarse.planes(), fine.planes(), &workers), alone) << threads;
    }
}

TEST(JointUpsampling, IsFiniteForAllSizesAndBlackSurfaces) {
    const auto black = [](float, float) { return Hit{{0, 0, 0}, {0, 0, 0}, 0}; };
    for (const auto& [w, h] : {std::pair{1, 1}, {1, 7}, {5, 1}, {16, 9}})
        for (const auto& [fine_w, fine_h] : {std::pair{1, 1}, {3, 50}, {64, 36}, {17, 9}}) {
            const Image coarse(w, h, black), fine(fine_w, fine_h, black);
            const std::vector<float> bright(size_t(3 * w * h), 1e9f);
            const std::vector<float> rgb = upsample_jointly(bright, coarse.planes(), fine.planes());
            for (const float value : rgb) ASSERT_NEAR(value, 1e9f, 1e4f) << w << " x " << h << " to " << fine_w << " x " << fine_h;
        }
}

} // namespace
} // namespace blush::TEST_FILE
