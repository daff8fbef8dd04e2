// A rendered region equals the same pixels of the whole image, and nothing else is rendered.
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

namespace blush::test::TEST_FILE {
namespace {

Frame render(const Scene& scene, const RenderSettings& settings, int divider = 1) {
    Renderer renderer({.threads = 2, .planes = {true, true, true, true}});
    renderer.update(scene, settings);
    renderer.set_divider(divider);
    EXPECT_TRUE(renderer.render(0, settings.spp));
    return renderer.resolve();
}

// True if `rendered` equals the whole image inside the region and is empty elsewhere.
void expect_crop(const Frame& part, const Frame& whole, const PixelRect& rendered) {
    ASSERT_EQ(part.width, whole.width);
    for (int y = 0; y < whole.height; ++y)
        for (int x = 0; x < whole.width; ++x) {
            const size_t i = size_t(y) * size_t(whole.width) + size_t(x);
            const bool inside = x >= rendered.x0 && x < rendered.x1 && y >= rendered.y0 && y < rendered.y1;
            for (size_t k = 0; k < 4; ++k) ASSERT_EQ(part.rgba[4 * i + k], inside ? whole.rgba[4 * i + k] : 0) << x << ' ' << y;
            ASSERT_EQ(part.object_id[i], inside ? whole.object_id[i] : 0u);
            ASSERT_EQ(part.albedo[i], inside ? whole.albedo[i] : (Vec3{0, 0, 0}));
        }
}

TEST(RenderRegion, IsTheSamePixelsOfTheWholeImage) {
    const Scene scene = shipped_scene("cornell");
    RenderSettings settings = settings_for(80, 48, 4);
    const Frame whole = render(scene, settings);
    for (const PixelRect r : {PixelRect{13, 5, 47, 31}, PixelRect{0, 0, 1, 1}, PixelRect{79, 0, 80, 48}, PixelRect{32, 16, 64, 32}}) {
        settings.region = {float(r.x0) / 80, float(r.y0) / 48, float(r.x1 - r.x0) / 80, float(r.y1 - r.y0) / 48};
        ASSERT_EQ(pixels_of(settings.region, 80, 48), r);
        const Frame part = render(scene, settings);
        expect_crop(part, whole, r);
        EXPECT_EQ(part.rays.camera, int64_t(r.x1 - r.x0) * (r.y1 - r.y0) * 4) << "all samples are in the region";
        EXPECT_EQ(part.samples, 4);
    }
}

TEST(RenderRegion, GrowsToWholeGroupsWherePathsAreShared) {
    const Scene scene = shipped_scene("cornell");
    RenderSettings settings = settings_for(80, 48, 4);
    settings.reuse = 16;
    const Frame whole = render(scene, settings);
    settings.region = {20 / 80.f, 17 / 48.f, 10 / 80.f, 10 / 48.f};
    expect_crop(render(scene, settings), whole, {0, 0, 64, 32});
}

TEST(RenderRegion, IsSampledEvenly) {
    const Scene scene = shipped_scene("cornell");
    RenderSettings settings = settings_for(48, 32, 24);
    settings.region = {0, 0, 0.5f, 1};
    const Frame even = render(scene, settings);
    settings.adaptive = true;
    EXPECT_EQ(render(scene, settings).rgba, even.rgba);
}

TEST(RenderRegion, WorksInCoarseImages) {
    const Scene scene = shipped_scene("cornell");
    RenderSettings settings = settings_for(80, 48, 1);
    const Frame whole = render(scene, settings, 4);
    settings.region = {0.5f, 0.25f, 0.25f, 0.5f};
    expect_crop(render(scene, settings, 4), whole, {10, 3, 15, 9});
}

TEST(RenderRegion, SetAndResetMatchesAFreshRenderer) {
    const Scene scene = shipped_scene("cornell");
    RenderSettings settings = settings_for(40, 24, 2);
    const Frame whole = render(scene, settings);
    Renderer renderer({.threads = 2});
    RenderSettings part = settings;
    part.region = {0.25f, 0.25f, 0.5f, 0.5f};
    renderer.update(scene, part);
    renderer.render(0, 2);
    EXPECT_TRUE(renderer.update(scene, settings)) << "the film is cleared";
    renderer.render(0, 2);
    EXPECT_EQ(renderer.resolve().rgba, whole.rgba);
}

} // namespace
} // namespace blush::test::TEST_FILE
