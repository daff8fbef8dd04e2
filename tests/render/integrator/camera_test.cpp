// Projections, lenses and pixel filters, tested with objects of known size and position.
#include "core/math.h"
#include "scene/affine.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

// A bright square [-half, half]^2 at height y in a black world.
Scene square(float half, float y) {
    Scene scene;
    place(scene, floor_quad(half, y), unlit({1, 1, 1}));
    return scene;
}

TEST(Camera, OrthographicViewsShowSizesAsTheyAre) {
    for (const float height : {0.f, -30.f}) {
        Scene scene = square(0.4f, height);
        scene.view = looking_down(1, 1);
        EXPECT_TRUE(is_mean(render(scene, settings_for(32, 32, 16)).whole(), 0.16, sidak(significance, 2)));
    }
}

TEST(Camera, PerspectiveShrinksWithDistance) {
    for (const double distance : {1.0, 2.5}) {
        Scene scene = square(0.4f, 0);
        scene.view = looking_down(1, float(distance));
        scene.view.lens.orthographic = false;
        scene.view.lens.yfov_radians = 1.2f;
        const double height = 2 * distance * std::tan(0.6), width = 2 * height;
        EXPECT_TRUE(is_mean(render(scene, settings_for(64, 32, 16)).whole(), 0.64 / (width * height), sidak(significance, 2)));
    }
}

// Right is right and up is up.
TEST(Camera, ImagesAreNotMirrored) {
    Scene scene;
    scene.view = looking({0, 0, 5}, {0, 0, 0}, 1);
    scene.view.rotation = {};
    place(scene, quad({0.2f, 0.3f, 0}, {0.4f, 0.3f, 0}, {0.4f, 0.6f, 0}, {0.2f, 0.6f, 0}), unlit({1, 1, 1}));
    const RenderedImage image = render(scene, settings_for(32, 32, 4));
    EXPECT_GT(image.region(16, 0, 16, 16).mean.x, 0);
    for (const auto& [x, y] : {std::pair{0, 0}, {0, 16}, {16, 16}}) EXPECT_EQ(image.region(x, y, 16, 16).mean.x, 0);
}

// Columns of many colours, at `depth` from the camera, slightly tilted, so that edges cross pixels at all offsets.
Scene striped(float depth) {
    Scene scene;
    for (int i = -8; i < 8; ++i) {
        const float x = 0.25f * float(i), c = float((i * i + 7 * i + 21) % 5) / 5;
        place(scene, quad({x, -2, -depth}, {x + 0.25f, -2, -depth}, {x + 0.25f, 2, -depth}, {x, 2, -depth}), unlit({c, 1 - c, c * c}));
    }
    scene.view = looking({0, 0, 0}, {0, 0, -1}, 0.8f);
    scene.view.rotation = {0, 0, std::sin(0.1f), std::cos(0.1f)};
    return scene;
}

TEST(Camera, ThinLensIsAPinholeForWhatIsInFocus) {
    for (const float depth : {1.5f, 3.f}) {
        Scene scene = striped(depth);
        const auto sharp = render(scene, settings_for(32, 32, 64)).blocks(4, 32);
        scene.view.lens.aperture_radius = 0.2f;
        scene.view.lens.focus_distance = depth;
        RenderSettings settings = settings_for(32, 32, 64);
        settings.seed = 1;
        EXPECT_TRUE(same_means(sharp, render(scene, settings).blocks(4, 32), sidak(significance, 2))) << depth;
        scene.view.lens.focus_distance = depth * 1.5f;
        EXPECT_FALSE(same_means(sharp, render(scene, settings).blocks(4, 32), sidak(significance, 2))) << "out of focus";
    }
}

// A thin line before a lens of radius r spreads over a disk of radius r |1 - focus / depth| in the plane of focus.
TEST(Camera, BlurHasTheWidthOfTheConeOfLight) {
    constexpr double radius = 0.3, focus = 2, depth = 1;
    Scene scene;
    place(scene, quad({-0.005f, -2, -float(depth)}, {0.005f, -2, -float(depth)}, {0.005f, 2, -float(depth)}, {-0.005f, 2, -float(depth)}),
          unlit({1, 1, 1}));
    scene.view = looking({0, 0, 0}, {0, 0, -1}, 2 * std::atan(0.5f)); // 2 m high in the plane of focus
    scene.view.rotation = {};
    scene.view.lens.aperture_radius = float(radius);
    scene.view.lens.focus_distance = float(focus);
    const RenderedImage image = render(scene, settings_for(64, 64, 64));
    const double blur = radius * std::abs(1 - focus / depth), pixel = 2.0 / 64;
    for (int x = 0; x < 64; ++x) {
        const double centre = std::abs((x + 0.5) * pixel - 1), mean = image.region(x, 0, 1, 64).mean.x;
        EXPECT_TRUE(mean > 0 || centre > blur - pixel) << x;
        EXPECT_TRUE(mean == 0 || centre < blur + pixel + 0.01 * focus / depth) << x;
    }
}

// A filter wider than a pixel weights positions unevenly, but uniformly on
// average: over steps of an eighth of a pixel the mean is exact for both.
TEST(Filter, KeepsTheMean) {
    for (const PixelFilter filter : {PixelFilter::box, PixelFilter::blackman_harris}) {
        Measured sum;
        for (int step = 0; step < 8; ++step) {
            const float left = -0.4f + float(step) / (8 * 16);
            Scene scene;
            place(scene, quad({left, 0, 2}, {left + 0.73f, 0, 2}, {left + 0.73f, 0, -2}, {left, 0, -2}), unlit({1, 1, 1}));
            scene.view = looking_down(1, 1);
            RenderSettings settings = settings_for(32, 32, 64);
            settings.filter = filter;
            settings.seed = uint32_t(step);
            const Measured one = render(scene, settings).whole();
            sum.mean = sum.mean + one.mean / 8;
            sum.error = sum.error + one.error * one.error / 64;
        }
        sum.error = {std::sqrt(sum.error.x), std::sqrt(sum.error.y), std::sqrt(sum.error.z)};
        EXPECT_TRUE(is_mean(sum, 0.73 / 2, sidak(significance, 2)));
    }
}

// Blackman-Harris of 1.5 pixels reaches three quarters of a pixel from the centre, the box one half.
TEST(Filter, HasItsWidth) {
    for (const auto& [filter, reach] : {std::pair{PixelFilter::box, 0.5}, {PixelFilter::blackman_harris, 0.75}}) {
        Scene scene;
        place(scene, quad({-2, 0, 2}, {0.1f, 0, 2}, {0.1f, 0, -2}, {-2, 0, -2}), unlit({1, 1, 1}));
        scene.view = looking_down(1, 1);
        RenderSettings settings = settings_for(20, 20, 256);
        settings.filter = filter;
        const RenderedImage image = render(scene, settings);
        // The edge lies between pixels 10 and 11, half a pixel from both centres.
        EXPECT_EQ(image.region(9, 0, 1, 20).mean.x, 1);
        EXPECT_EQ(image.region(10, 0, 1, 20).mean.x == 1, reach <= 0.5);
        EXPECT_EQ(image.region(11, 0, 1, 20).mean.x == 0, reach <= 0.5);
        EXPECT_EQ(image.region(12, 0, 1, 20).mean.x, 0);
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
