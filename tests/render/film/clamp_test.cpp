// Clamping removes exactly the light that it reports, nothing else, and only if enabled.
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

namespace blush::test::TEST_FILE {
namespace {

struct Rendered {
    Frame frame;
    double luminance = 0; // mean over the image
};
Rendered render_clamped(const Clamp& clamp, int bounces = 0, unsigned threads = 1) {
    Renderer renderer({.threads = threads, .planes = {.bounces = bounces}});
    RenderSettings settings = settings_for(32, 24, 8);
    settings.clamp = clamp;
    renderer.update(shipped_scene("cornell"), settings);
    renderer.render(0, settings.spp);
    Rendered r{renderer.resolve(), 0};
    for (size_t i = 0; i < r.frame.rgba.size(); i += 4)
        r.luminance += 0.212671 * double(r.frame.rgba[i]) + 0.715160 * double(r.frame.rgba[i + 1]) + 0.072169 * double(r.frame.rgba[i + 2]);
    r.luminance /= 32 * 24;
    return r;
}

TEST(Clamp, IsOffByDefault) {
    EXPECT_EQ(RenderSettings{}.clamp.limit, 0);
    const Rendered r = render_clamped({});
    EXPECT_EQ(r.frame.clamp.samples, 0);
    EXPECT_EQ(r.frame.clamp.share, 0);
    EXPECT_EQ(r.frame.rgba, render_clamped({1e30f, true}).frame.rgba) << "a limit above all samples changes nothing";
}

TEST(Clamp, ReportsTheRemovedLight) {
    const Rendered plain = render_clamped({});
    for (const bool all : {false, true}) {
        const Rendered clamped = render_clamped({0.3f, all});
        const ClampReport& report = clamped.frame.clamp;
        EXPECT_GT(report.samples, 0);
        EXPECT_LT(clamped.luminance, plain.luminance);
        const double removed = 0.212671 * report.removed.x + 0.715160 * report.removed.y + 0.072169 * report.removed.z;
        // Each pixel's float is rounded once.
        EXPECT_NEAR(clamped.luminance + removed, plain.luminance, plain.luminance * 0x1p-23);
        EXPECT_NEAR(report.share, removed / plain.luminance, 1e-6);
    }
}

TEST(Clamp, LimitsEverySample) {
    const Rendered clamped = render_clamped({0.3f, true});
    for (size_t i = 0; i < clamped.frame.rgba.size(); i += 4)
        for (size_t c = 0; c < 3; ++c) EXPECT_LE(clamped.frame.rgba[i + c], 0.3f);
}

// Light that was scattered at most once is unchanged; the planes of the rest are scaled and still sum to the beauty.
TEST(Clamp, OfIndirectLightKeepsDirectLight) {
    const Frame plain = render_clamped({}, 4).frame, clamped = render_clamped({0.05f, false}, 4).frame;
    EXPECT_EQ(plain.bounces[0], clamped.bounces[0]);
    EXPECT_EQ(plain.bounces[1], clamped.bounces[1]);
    EXPECT_NE(plain.bounces[2], clamped.bounces[2]);
    for (size_t i = 0; i < 32 * 24; ++i) {
        double sum = 0;
        for (const auto& plane : clamped.bounces) sum += double(plane[i].y);
        EXPECT_NEAR(sum, double(clamped.rgba[4 * i + 1]), sum * 0x1.01p-23);
        const double indirect = double(clamped.bounces[2][i].y) + double(clamped.bounces[3][i].y);
        EXPECT_LE(indirect, 0.05 * (1 + 0x1p-22));
    }
}

TEST(Clamp, DoesNotDependOnThreads) {
    const Frame one = render_clamped({0.3f, false}, 0, 1).frame, three = render_clamped({0.3f, false}, 0, 3).frame;
    EXPECT_EQ(one.rgba, three.rgba);
    EXPECT_EQ(one.clamp.samples, three.clamp.samples);
    EXPECT_EQ(one.clamp.removed, three.clamp.removed);
}

} // namespace
} // namespace blush::test::TEST_FILE
