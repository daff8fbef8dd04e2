// A scene is shown without textures first, then with them: the final
// image equals that of a renderer that never saw the untextured scene.
#include "render/renderer.h"
#include "scene/document/preview_scene.h"
#include "tests/support/images.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

#include <cmath>

namespace blush::TEST_FILE {
namespace {

RenderSettings small() {
    RenderSettings settings;
    settings.width = 48;
    settings.height = 32;
    settings.spp = 4;
    return settings;
}

TEST(PreviewScene, IsReplacedByTheTexturedScene) {
    const test::Sample sample = test::sample_project();
    const Scene& whole = sample.project.scene;
    Scene without_images = whole;
    for (const auto& [id, texture] : whole.textures) {
        Texture missing = texture;
        missing.image = nullptr;
        without_images.textures.set(id, missing);
    }
    Renderer renderer(test::all_planes());
    renderer.update(preview_scene(without_images), small());
    renderer.render(0, 4);
    const Frame early = renderer.resolve();
    double light = 0;
    for (const float v : early.rgba) {
        ASSERT_TRUE(std::isfinite(v));
        light += v;
    }
    EXPECT_GT(light, 0);
    EXPECT_FALSE(test::same_pixels(early, test::fresh_image(whole, small(), 4)));
    renderer.update(whole, small());
    renderer.render(0, 4);
    EXPECT_TRUE(test::same_pixels(renderer.resolve(), test::fresh_image(whole, small(), 4)));
}

} // namespace
} // namespace blush::TEST_FILE
