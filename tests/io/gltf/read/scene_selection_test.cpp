// Files with several scenes, and KHR_materials_variants.
#include "io/gltf/write/save.h"
#include "scene/document/scene_selection.h"
#include "tests/io/gltf/saving.h"

#include <gtest/gtest.h>

namespace blush::test::TEST_FILE {
namespace {

ImportedScene imported(const GltfBuilder& builder) {
    Result<ImportedScene> result = import_built(builder);
    EXPECT_TRUE(result) << error_text(result);
    return result ? *std::move(result) : ImportedScene{};
}

std::vector<std::string> shown_names(const Scene& scene) {
    std::vector<std::string> names;
    for (const auto& [id, node] : scene.nodes)
        if (is_visible(scene, id)) names.push_back(node.name);
    return names;
}

// A floor in both scenes, a lamp with a shade by day, a candle by night (the default scene).
GltfBuilder two_scenes() {
    GltfBuilder b;
    const int positions = b.triangle_positions();
    for (const char* name : {"floor", "lamp", "shade", "candle"}) {
        const int node = b.show({{"attributes", {{"POSITION", positions}}}});
        b.json["nodes"][size_t(node)]["name"] = name;
    }
    b.json["nodes"][1]["children"] = {2};
    b.json["scenes"] = {{{"name", "Day"}, {"nodes", {0, 1}}}, {{"nodes", {3, 0}}}};
    b.json["scene"] = 1;
    return b;
}

TEST(GltfScenes, TheDefaultSceneIsShown) {
    const ImportedScene s = imported(two_scenes());
    EXPECT_EQ(s.scene.scene_names, (std::vector<std::string>{"Day", "Scene 1"}));
    EXPECT_EQ(s.scene.scene_selection.scene, 1);
    EXPECT_EQ(shown_names(s.scene), (std::vector<std::string>{"floor", "candle"}));
    EXPECT_EQ(shown_names(with_scene_selection(s.scene, {.scene = 0})), (std::vector<std::string>{"floor", "lamp", "shade"}));
    EXPECT_FALSE(reports(s.report, "belong to no scene"));
}

TEST(GltfScenes, OneSceneIsNoChoice) {
    GltfBuilder b = two_scenes();
    b.json["scenes"].erase(1);
    b.json["scene"] = 0;
    const ImportedScene s = imported(b);
    EXPECT_TRUE(s.scene.scene_names.empty());
    EXPECT_EQ(s.scene.nodes.size(), 3u);
    EXPECT_TRUE(reports(s.report, "1 nodes that belong to no scene"));
    for (const auto& [id, node] : s.scene.nodes) EXPECT_TRUE(node.only_in_scenes.empty());
}

TEST(GltfScenes, SurviveASaveWithTheChoice) {
    const TempFolder folder;
    write_bytes(folder / "scenes.gltf", two_scenes().gltf());
    const ImportedScene original = load(folder / "scenes.gltf");
    for (const int32_t chosen : {0, 1}) {
        Project project{with_scene_selection(original.scene, {.scene = chosen}), {}, {}};
        const Edit lamp = AddLight{};
        project = *blush::apply(project, lamp);
        const auto saved = save_gltf(original.origin, project, folder / "saved.gltf");
        ASSERT_TRUE(saved) << error_text(saved);
        for (const Diagnostic& d : saved->diagnostics) ADD_FAILURE() << d.what;
        const ImportedScene loaded = load(folder / "saved.gltf");
        EXPECT_EQ(loaded.scene.scene_selection.scene, chosen);
        EXPECT_EQ(loaded.scene.nodes, saved->scene.nodes);
        EXPECT_EQ(shown_names(loaded.scene), shown_names(saved->scene)) << "the new light is in both scenes";
        EXPECT_EQ(Json::parse(text_of(folder / "saved.gltf"))["scene"], 1) << "other scenes are unchanged";
    }
}

TEST(GltfScenes, BrokenRootsAreRefused) {
    GltfBuilder twice = two_scenes(), child = two_scenes(), beyond = two_scenes();
    twice.json["scenes"][0]["nodes"] = {0, 0};
    child.json["scenes"][0]["nodes"] = {2};
    beyond.json["scenes"][0]["nodes"] = {50};
    EXPECT_NE(error_text(import_built(twice)).find("listed twice"), std::string::npos);
    EXPECT_NE(error_text(import_built(child)).find("is a child"), std::string::npos);
    EXPECT_NE(error_text(import_built(beyond)).find("node 50 does not exist"), std::string::npos);
}

// A chair with red cloth, blue in the second variant and green in the third.
GltfBuilder chair() {
    GltfBuilder b;
    for (const char* name : {"red", "blue", "green"}) b.add("materials", {{"name", name}});
    const int positions = b.triangle_positions();
    b.show({{"attributes", {{"POSITION", positions}}},
            {"material", 0},
            {"extensions",
             {{"KHR_materials_variants", {{"mappings", {{{"material", 1}, {"variants", {1}}}, {{"material", 2}, {"variants", {2}}}}}}}}}});
    b.json["extensionsUsed"] = {"KHR_materials_variants"};
    b.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "Plain"}}, {{"name", "Sea"}}, {{"name", "Forest"}}};
    return b;
}

std::string assigned_material(const Scene& scene) {
    const Material* material = scene.materials.find(scene.meshes.begin()->value.parts[0].material);
    return material ? material->name : "";
}

TEST(GltfVariants, AssignMaterials) {
    const ImportedScene s = imported(chair());
    EXPECT_EQ(s.scene.variants, (std::vector<std::string>{"Plain", "Sea", "Forest"}));
    EXPECT_EQ(s.report.extensions_honoured, (std::vector<std::string>{"KHR_materials_variants"}));
    EXPECT_EQ(assigned_material(s.scene), "red");
    EXPECT_EQ(assigned_material(with_scene_selection(s.scene, {.variant = 0})), "red") << "has no mapping";
    EXPECT_EQ(assigned_material(with_scene_selection(s.scene, {.variant = 1})), "blue");
    EXPECT_EQ(assigned_material(with_scene_selection(with_scene_selection(s.scene, {.variant = 1}), {.variant = 2})), "green");
    EXPECT_EQ(assigned_material(with_scene_selection(with_scene_selection(s.scene, {.variant = 1}), {})), "red");
}

TEST(GltfVariants, SurviveASaveWithChoiceAndAssignments) {
    const TempFolder folder;
    write_bytes(folder / "chair.gltf", chair().gltf());
    const ImportedScene original = load(folder / "chair.gltf");
    const Id<Mesh> mesh = original.scene.meshes.begin()->id;
    const Id<Material> green = original.scene.materials.entries()[2].id;
    Project project{with_scene_selection(original.scene, {.variant = 1}), {}, {}};
    for (const bool assigned : {false, true}) {
        if (assigned) project = *blush::apply(project, AssignMaterial{mesh, 0, green});
        const auto saved = save_gltf(original.origin, project, folder / "saved.gltf");
        ASSERT_TRUE(saved) << error_text(saved);
        for (const Diagnostic& d : saved->diagnostics) ADD_FAILURE() << d.what;
        const ImportedScene loaded = load(folder / "saved.gltf");
        EXPECT_EQ(loaded.scene.scene_selection.variant, 1);
        EXPECT_EQ(assigned_material(loaded.scene), assigned ? "green" : "blue");
        EXPECT_EQ(assigned_material(with_scene_selection(loaded.scene, {})), "red");
        EXPECT_EQ(assigned_material(with_scene_selection(loaded.scene, {.variant = 2})), "green");
        EXPECT_EQ(loaded.scene.meshes.begin()->value.parts[0].by_variant, saved->scene.meshes.begin()->value.parts[0].by_variant);
    }
}

TEST(GltfVariants, BrokenMappingsAreReported) {
    GltfBuilder no_material = chair(), no_variant = chair(), many = chair();
    const Json::json_pointer mapping("/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/0");
    no_material.json[mapping]["material"] = 9;
    EXPECT_NE(error_text(import_built(no_material)).find("a material that does not exist"), std::string::npos);
    no_variant.json[mapping]["variants"] = {7, "x"};
    const ImportedScene s = imported(no_variant);
    EXPECT_TRUE(reports(s.report, "a variant that does not exist"));
    EXPECT_EQ(assigned_material(with_scene_selection(s.scene, {.variant = 1})), "red");
    for (int i = 0; i < 3000; ++i) many.json["extensions"]["KHR_materials_variants"]["variants"].push_back({{"name", "more"}});
    EXPECT_EQ(imported(many).scene.variants.size(), 1000u);
}

} // namespace
} // namespace blush::test::TEST_FILE
