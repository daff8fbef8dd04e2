#include "tests/io/gltf/builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace blush::test::TEST_FILE {
namespace {

TEST(GltfNodes, HierarchyAndTransformsAreKept) {
    GltfBuilder b;
    b.add("nodes", {{"name", "parent"}, {"translation", {1, 2, 3}}, {"children", {1}}});
    b.add("nodes", {{"name", "child"}, {"scale", {2, 2, 2}}, {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    const auto& nodes = imported->scene.nodes.entries();
    ASSERT_EQ(nodes.size(), 2u);
    EXPECT_EQ(nodes[0].value.name, "parent");
    EXPECT_EQ(nodes[1].value.parent, nodes[0].id);
    const Affined world = world_from_node(imported->scene, nodes[1].id);
    EXPECT_EQ(world.t, (Vec3d{1, 2, 3}));
    EXPECT_NEAR(world.x.z, -2, 1e-6); // a quarter turn about +Y sends +X to -Z
}

TEST(GltfNodes, MatricesAreColumnMajor) {
    GltfBuilder b;
    b.add("nodes", {{"matrix", {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1}}});
    b.add("nodes", {{"matrix", {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}); // sheared
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    const auto& nodes = imported->scene.nodes.entries();
    EXPECT_EQ(nodes[0].value.local.translation, (Vec3{5, 6, 7}));
    EXPECT_EQ(nodes[0].value.local.scale, (Vec3{2, 3, 4}));
    EXPECT_FALSE(nodes[0].value.local.matrix);
    ASSERT_TRUE(nodes[1].value.local.matrix);
    EXPECT_EQ(nodes[1].value.local.matrix->y, (Vec3{1, 1, 0}));
}

TEST(GltfNodes, CyclesAndSecondParentsAreErrors) {
    GltfBuilder cycle;
    cycle.add("nodes", {{"children", {1}}});
    cycle.add("nodes", {{"children", {0}}});
    EXPECT_NE(error_text(import_built(cycle)).find("its own ancestor"), std::string::npos);
    GltfBuilder self;
    self.add("nodes", {{"children", {0}}});
    EXPECT_NE(error_text(import_built(self)).find("its own ancestor"), std::string::npos);
    GltfBuilder shared;
    shared.add("nodes", {{"children", {2}}});
    shared.add("nodes", {{"children", {2}}});
    shared.add("nodes", Json::object({{"name", "shared"}}));
    EXPECT_NE(error_text(import_built(shared)).find("two parents"), std::string::npos);
    GltfBuilder beyond;
    beyond.add("nodes", {{"children", {7}}});
    EXPECT_NE(error_text(import_built(beyond)).find("child 7 does not exist"), std::string::npos);
}

TEST(GltfNodes, AHundredThousandLevelsDeep) {
    constexpr int depth = 100000;
    std::string nodes;
    for (int i = 0; i + 1 < depth; ++i) nodes += "{\"children\":[" + std::to_string(i + 1) + "]},";
    const TempFolder folder;
    const auto imported = import_text(folder, R"({"asset":{"version":"2.0"},"nodes":[)" + nodes + R"({"translation":[1,0,0]}]})");
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_EQ(imported->scene.nodes.size(), size_t(depth));
}

TEST(GltfNodes, TransformsThatAreNotFiniteNameTheirNode) {
    GltfBuilder b;
    b.add("nodes", {{"name", "broken"}, {"translation", {1e300, 0, 0}}});
    EXPECT_NE(error_text(import_built(b)).find("'broken'"), std::string::npos);
    GltfBuilder product;
    product.add("nodes", {{"scale", {1e38, 1, 1}}, {"children", {1}}});
    for (int i = 1; i < 9; ++i) product.add("nodes", {{"scale", {1e38, 1, 1}}, {"children", {i + 1}}});
    product.add("nodes", {{"name", "last"}});
    EXPECT_NE(error_text(import_built(product)).find("its world transform is not finite"), std::string::npos);
    GltfBuilder short_matrix;
    short_matrix.add("nodes", {{"matrix", {1, 2, 3}}});
    EXPECT_NE(error_text(import_built(short_matrix)).find("wrong number of elements"), std::string::npos);
}

TEST(GltfCameras, ThePerspectiveCameraBecomesTheView) {
    GltfBuilder b;
    b.show({{"attributes", {{"POSITION", b.triangle_positions()}}}});
    b.add("cameras", {{"type", "perspective"},
                      {"name", "Shot"},
                      {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}},
                      {"extras", {{"blush", {{"aperture_radius", 0.02}, {"focus_distance", 3.5}}}}}});
    b.add("nodes", {{"camera", 0}, {"translation", {0, 0, 4}}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    const View& view = imported->scene.view;
    EXPECT_EQ(view.position, (Vec3{0, 0, 4}));
    EXPECT_FLOAT_EQ(view.lens.yfov_radians, 0.5f);
    EXPECT_FLOAT_EQ(view.lens.aperture_radius, 0.02f);
    EXPECT_FLOAT_EQ(view.lens.focus_distance, 3.5f);
    EXPECT_FLOAT_EQ(view.pivot_distance, 4);
    EXPECT_EQ(imported->scene.cameras.begin()->value.name, "Shot");
}

TEST(GltfCameras, OrthographicCamerasKeepHalfTheirHeight) {
    GltfBuilder b;
    b.add("cameras", {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 1.5}, {"znear", 0}, {"zfar", 10}}}});
    b.add("nodes", {{"camera", 0}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_TRUE(imported->scene.view.lens.orthographic);
    EXPECT_FLOAT_EQ(imported->scene.view.lens.ymag, 1.5f);
}

TEST(GltfCameras, WithoutOneEverythingIsFramedFromAnAngle) {
    GltfBuilder b;
    b.show({{"attributes", {{"POSITION", b.accessor<float>({-1, -1, -1, 1, 1, 1, 1, -1, 1}, "VEC3")}}}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    const View& view = imported->scene.view;
    EXPECT_GT(view.position.x, 0);
    EXPECT_GT(view.position.y, 0);
    EXPECT_GT(view.position.z, 0);
    // The axis goes through the middle of the bounds, which is the origin here.
    const double distance = std::hypot(view.position.x, view.position.y, view.position.z);
    EXPECT_NEAR(view.pivot_distance, distance, 1e-4 * distance);
    EXPECT_GT(distance, std::sqrt(3.0));
}

TEST(GltfImport, ReportsProgressAndCanBeCancelled) {
    GltfBuilder b;
    b.show({{"attributes", {{"POSITION", b.triangle_positions()}}}});
    std::vector<double> fractions;
    ImportOptions options;
    options.on_progress = [&](double fraction, const std::string&) { fractions.push_back(fraction); };
    ASSERT_TRUE(import_built(b, options));
    ASSERT_GE(fractions.size(), 3u);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_EQ(fractions.front(), 0);
    EXPECT_EQ(fractions.back(), 1);
    const std::atomic<bool> cancel = true;
    options.cancel = &cancel;
    const auto cancelled = import_built(b, options);
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().what, "cancelled");
}

TEST(GltfImport, TextAndBinaryFormsGiveTheSameScene) {
    GltfBuilder b;
    b.show({{"attributes", {{"POSITION", b.triangle_positions()}}}});
    const TempFolder folder;
    const auto text = import_text(folder, b.gltf()), binary = import_text(folder, b.glb());
    ASSERT_TRUE(text) << error_text(text);
    ASSERT_TRUE(binary) << error_text(binary);
    EXPECT_EQ(text->scene.nodes, binary->scene.nodes);
    EXPECT_EQ(text->scene.meshes.begin()->value.parts[0].geometry->positions,
              binary->scene.meshes.begin()->value.parts[0].geometry->positions);
}

} // namespace
} // namespace blush::test::TEST_FILE
