// Leaves of a tree: many instances of one mesh with stochastic alpha share their memory, and their opacities are independent.
#include "tests/render/session/rich_project.h"
#include "tests/support/images.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

#include <cmath>

namespace blush::TEST_FILE {
namespace {

// `count` instances behind each other, black with opacity 1/2, under a white sky.
Project leaves(const GeometryPtr& geometry, int count, float scale) {
    Project project;
    Scene& scene = project.scene;
    Material black;
    black.base_color = {0, 0, 0};
    black.metallic = black.specular = 0;
    black.alpha = Material::Alpha::blend;
    black.opacity = 0.5f;
    black.double_sided = true;
    const Id<Mesh> mesh = scene.meshes.add({"Leaf", {{geometry, scene.materials.add(black)}}});
    for (int i = 0; i < count; ++i) {
        Node node;
        node.mesh = mesh;
        node.local.translation = {0, 0, -0.1f * float(i)};
        node.local.scale = {scale, scale, scale};
        scene.nodes.add(node);
    }
    scene.environment.kind = Environment::Kind::constant;
    project.render.width = 32;
    project.render.height = 32;
    return project;
}

TEST(AlphaInstances, ShareTheirMemory) {
    const auto memory_of = [](int count) {
        const Project project = leaves(test::hill_geometry(), count, 1);
        Renderer renderer;
        renderer.update(project.scene, project.render);
        return renderer.info().memory_mb;
    };
    EXPECT_LT(memory_of(20), 1.5 * memory_of(2));
}

TEST(AlphaInstances, TransmitLightIndependently) {
    for (const int count : {2, 3}) {
        const Project project = leaves(test::quad_geometry(), count, 100);
        const Frame image = test::fresh_image(project.scene, project.render, 16);
        double sum = 0;
        for (size_t i = 0; i < image.rgba.size(); i += 4) sum += double(image.rgba[i]);
        const double pixels = double(image.rgba.size() / 4), p = std::pow(0.5, count);
        const double sigma = std::sqrt(p * (1 - p) / (16 * pixels)); // each sample sees the sky or does not
        EXPECT_NEAR(sum / pixels, p, 5 * sigma) << count << " leaves";
    }
}

} // namespace
} // namespace blush::TEST_FILE
