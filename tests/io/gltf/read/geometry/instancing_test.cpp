// EXT_mesh_gpu_instancing: instance transforms, round trip through a save, and invalid files.
#include "io/gltf/write/save.h"
#include "io/project/scene_edits_json.h"
#include "io/project/scene_hash.h"
#include "scene/affine.h"
#include "tests/io/gltf/saving.h"

#include <gtest/gtest.h>

#include <limits>

namespace blush::test::TEST_FILE {
namespace {

constexpr const char* extension = "EXT_mesh_gpu_instancing";

// A triangle whose node has the attributes given.
GltfBuilder with_copies(GltfBuilder b, const Json& attributes) {
    const int node = b.show({{"attributes", {{"POSITION", b.triangle_positions()}}}});
    b.json["nodes"][size_t(node)]["extensions"][extension] = {{"attributes", attributes}};
    b.json["extensionsUsed"] = {extension};
    return b;
}

GltfBuilder three_copies() {
    GltfBuilder b;
    const int places = b.accessor<float>({0, 0, 0, 1, 2, 3, -1, 0, 4}, "VEC3");
    const int rotations = b.accessor<float>({0, 0, 0, 1, 0, 0.6f, 0, 0.8f, 0.5f, 0.5f, 0.5f, 0.5f}, "VEC4");
    const int scales = b.accessor<float>({1, 1, 1, 2, 3, 4, 0.5f, 1, -1}, "VEC3");
    return with_copies(b, {{"TRANSLATION", places}, {"ROTATION", rotations}, {"SCALE", scales}, {"_ID", places}});
}

std::vector<Affine> places_of(const Scene& scene, size_t node = 0) {
    const InstancesPtr& instances = scene.nodes.entries().at(node).value.instances;
    return instances ? instances->node_from_copy : std::vector<Affine>();
}

TEST(GltfInstancing, TransformsAreProductsOfTheirParts) {
    const auto imported = import_built(three_copies());
    ASSERT_TRUE(imported) << error_text(imported);
    const std::vector<Affine> places = places_of(imported->scene);
    ASSERT_EQ(places.size(), 3u);
    EXPECT_EQ(places[0], Affine{});
    Transform second, third;
    second.translation = {1, 2, 3}, second.rotation = {0, 0.6f, 0, 0.8f}, second.scale = {2, 3, 4};
    third.translation = {-1, 0, 4}, third.rotation = {0.5f, 0.5f, 0.5f, 0.5f}, third.scale = {0.5f, 1, -1};
    EXPECT_EQ(places[1], to_float(to_affine(second)));
    EXPECT_EQ(places[2], to_float(to_affine(third)));
    EXPECT_TRUE(reports(imported->report, "ignored: attribute _ID"));
    EXPECT_EQ(imported->report.extensions_honoured, std::vector<std::string>{extension});
}

TEST(GltfInstancing, QuantisedRotationsAreRead) {
    GltfBuilder b;
    const int bytes = b.accessor<int8_t>({0, 127, 0, 0, 0, 0, 0, 127}, "VEC4", true);
    const auto imported = import_built(with_copies(b, {{"ROTATION", bytes}}));
    ASSERT_TRUE(imported) << error_text(imported);
    const std::vector<Affine> places = places_of(imported->scene);
    ASSERT_EQ(places.size(), 2u);
    EXPECT_EQ(places[0].x, (Vec3{-1, 0, 0})) << "half a turn about +Y";
    EXPECT_EQ(places[0].z, (Vec3{0, 0, -1}));
    EXPECT_EQ(places[1], Affine{});
}

TEST(GltfInstancing, HostileInstancesAreRefusedOrReported) {
    const auto with = [](const auto& attributes) {
        GltfBuilder b;
        const int two = b.accessor<float>({0, 0, 0, 1, 1, 1}, "VEC3"), three = b.accessor<float>({0, 0, 0, 1, 1, 1, 2, 2, 2}, "VEC3");
        const Json built = attributes(b, two, three);
        return import_built(with_copies(b, built));
    };
    EXPECT_NE(error_text(with([](auto&, int two, int three) {
                  return Json{{"TRANSLATION", two}, {"SCALE", three}};
              })).find("of 3 and of 2 copies"),
              std::string::npos);
    EXPECT_NE(error_text(with([](auto&, int two, int) {
                  return Json{{"TRANSLATION", two}, {"SCALE", 99}};
              })).find("accessor 99"),
              std::string::npos);
    EXPECT_NE(error_text(with([](auto&, int two, int) {
                  return Json{{"ROTATION", two}};
              })).find("wrong number of components"),
              std::string::npos);

    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), large = std::numeric_limits<float>::max();
    const auto lost = with([&](GltfBuilder& b, int, int) {
        return Json{{"TRANSLATION", b.accessor<float>({nan, 0, 0, 1, 0, 0, 0, 0, 0}, "VEC3")},
                    {"SCALE", b.accessor<float>({1, 1, 1, 1, 1, 1, large, large, large}, "VEC3")}};
    });
    ASSERT_TRUE(lost) << error_text(lost);
    EXPECT_EQ(places_of(lost->scene).size(), 2u);
    EXPECT_TRUE(reports(lost->report, "1 instances with non-finite transforms"));

    // Sixteen million instances that need no bytes in the file, and zero instances.
    const auto nowhere = with([](GltfBuilder& b, int, int) {
        return Json{{"TRANSLATION", b.add("accessors", {{"componentType", 5126}, {"count", 1 << 24}, {"type", "VEC3"}})}};
    });
    ASSERT_TRUE(nowhere) << error_text(nowhere);
    EXPECT_FALSE(nowhere->scene.nodes.begin()->value.instances);
    EXPECT_TRUE(reports(nowhere->report, "no instance transforms"));
    EXPECT_TRUE(with([](auto&, int, int) { return Json("attributes"); }));

    GltfBuilder bare;
    const int places = bare.accessor<float>({0, 0, 0}, "VEC3");
    bare.add("nodes", {{"extensions", {{extension, {{"attributes", {{"TRANSLATION", places}}}}}}}});
    const auto without_mesh = import_built(bare);
    ASSERT_TRUE(without_mesh) << error_text(without_mesh);
    EXPECT_TRUE(reports(without_mesh->report, "instances on a node without a mesh"));
}

// Many nodes may share an array: the limit is on the total number of instances.
TEST(GltfInstancing, InstancesAreCountedOverAllNodes) {
    GltfBuilder b;
    const std::vector<int8_t> turns(4 << 20, 127);
    const int rotations = b.accessor<int8_t>(turns, "VEC4", true);
    b = with_copies(std::move(b), {{"ROTATION", rotations}});
    for (int i = 0; i < 8; ++i) b.add("nodes", Json(b.json["nodes"][0]));
    EXPECT_NE(error_text(import_built(b)).find("more than 8388608 instances"), std::string::npos);
}

TEST(GltfInstancing, AreUnchangedByASave) {
    const TempFolder folder;
    write_bytes(folder / "scene.gltf", three_copies().gltf());
    const ImportedScene original = load(folder / "scene.gltf");
    Project project{original.scene, {}, {}};
    const Id<Node> node = original.scene.nodes.begin()->id;
    Node moved = *original.scene.nodes.find(node);
    moved.local.translation = {0, 1, 0};
    project = *blush::apply(project, SetNode{node, moved});
    const auto saved = save_gltf(original.origin, project, folder / "saved.gltf");
    ASSERT_TRUE(saved) << error_text(saved);
    EXPECT_TRUE(saved->diagnostics.empty());
    const Json before = Json::parse(text_of(folder / "scene.gltf")), after = Json::parse(text_of(folder / "saved.gltf"));
    EXPECT_EQ(after["nodes"][0]["extensions"], before["nodes"][0]["extensions"]);
    EXPECT_EQ(after["accessors"], before["accessors"]);
    const ImportedScene loaded = load(folder / "saved.gltf");
    EXPECT_EQ(places_of(loaded.scene), places_of(original.scene));
    EXPECT_EQ(scene_hash(loaded.scene), scene_hash(project.scene));
}

// Instances of a duplicate and of an imported scene are not in the document yet.
TEST(GltfInstancing, NewInstancesAreWritten) {
    const TempFolder folder;
    write_bytes(folder / "scene.gltf", three_copies().gltf());
    const ImportedScene original = load(folder / "scene.gltf");
    Project project{original.scene, {}, {}};
    project = *blush::apply(project, DuplicateNode{original.scene.nodes.begin()->id});
    project = *blush::apply(project, Import{original.scene, "scene.gltf"});
    ASSERT_EQ(project.scene.nodes.size(), 3u);
    const auto saved = save_gltf(original.origin, project, folder / "saved.glb");
    ASSERT_TRUE(saved) << error_text(saved);
    const ImportedScene loaded = load(folder / "saved.glb");
    const std::vector<Affine> wanted = places_of(original.scene);
    for (size_t node = 0; node < 3; ++node) {
        const std::vector<Affine> places = places_of(loaded.scene, node);
        ASSERT_EQ(places.size(), wanted.size()) << node;
        for (size_t i = 0; i < wanted.size(); ++i)
            for (const auto column : {&Affine::x, &Affine::y, &Affine::z, &Affine::t})
                EXPECT_LT(length(places[i].*column - wanted[i].*column), 1e-5f) << node << " " << i;
    }
    // After the save they are in the document.
    const auto again = save_gltf(saved->origin, {saved->scene, {}, {}}, folder / "again.glb");
    ASSERT_TRUE(again) << error_text(again);
    EXPECT_EQ(scene_hash(load(folder / "again.glb").scene), scene_hash(loaded.scene));
}

TEST(GltfInstancing, EditsAsJsonListThemAsLeftOut) {
    const auto imported = import_built(three_copies());
    ASSERT_TRUE(imported) << error_text(imported);
    const Project before{imported->scene, {}, {}};
    const Project duplicated = *blush::apply(before, DuplicateNode{before.scene.nodes.begin()->id});
    const std::string text = edits_json(before.scene, duplicated.scene);
    const auto applied = apply_edits_json(before.scene, text);
    ASSERT_TRUE(applied) << error_text(applied);
    EXPECT_EQ(*applied, duplicated.scene) << text;
    EXPECT_EQ(count_left_out(text), 0u);

    const Project merged = *blush::apply(before, Import{import_built(three_copies())->scene, "other"});
    EXPECT_GT(count_left_out(edits_json(before.scene, merged.scene)), 0u);
}

} // namespace
} // namespace blush::test::TEST_FILE
