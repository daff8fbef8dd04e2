#include "io/image/ies.h"
#include "io/image/image_io.h"
#include "io/project/scene_edits_json.h"
#include "io/project/scene_hash.h"
#include "tests/io/gltf/builder.h"
#include "tests/support/random_edits.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace blush::test::TEST_FILE {
namespace {

// The part that JSON can store: pixels are those of the import.
Scene with_imported_pixels(const Scene& imported, Scene now) {
    const Table<Texture> textures = now.textures;
    for (auto [id, texture] : textures) {
        texture.image = imported.textures.find(id)->image;
        now.textures.set(id, texture);
    }
    // IES profiles of random lights have no file.
    const Table<Light> lights = now.lights;
    for (auto [id, light] : lights) {
        light.ies = nullptr;
        now.lights.set(id, light);
    }
    now.clips = imported.clips;
    return now;
}

bool is_storable_as_text(const Edit& edit) {
    if (const auto* set = std::get_if<SetEnvironment>(&edit)) return set->environment.kind != Environment::Kind::image;
    return !std::holds_alternative<Import>(edit);
}

TEST(SceneEdits, NoChangeGivesOnlyTheFormat) {
    const Scene scene = sample_project().project.scene;
    EXPECT_EQ(edits_json(scene, scene), R"({"format":1})");
    const auto applied = apply_edits_json(scene, R"({"format":1})");
    ASSERT_TRUE(applied) << error_text(applied);
    EXPECT_EQ(*applied, scene);
}

TEST(SceneEdits, RandomEditsRoundTrip) {
    const Project imported = sample_project().project;
    Rng rng(11);
    for (int sequence = 0; sequence < 50; ++sequence) {
        Project project = imported;
        for (int step = 0; step < 8; ++step) {
            const Edit edit = random_edit(rng, project);
            if (is_storable_as_text(edit)) project = *blush::apply(project, edit);
        }
        const std::string text = edits_json(imported.scene, project.scene);
        const auto applied = apply_edits_json(imported.scene, text);
        ASSERT_TRUE(applied) << error_text(applied) << "\n" << text;
        const Scene expected = with_imported_pixels(imported.scene, project.scene);
        ASSERT_EQ(*applied, expected) << text;
        EXPECT_EQ(scene_hash(*applied), scene_hash(expected));
    }
}

TEST(SceneEdits, OnlyWhatChangedIsWritten) {
    const Sample sample = sample_project();
    Scene now = sample.project.scene;
    Light lamp = *now.lights.find(sample.lamp);
    lamp.intensity = 250;
    now.lights.set(sample.lamp, lamp);
    EXPECT_EQ(edits_json(sample.project.scene, now),
              R"({"format":1,"lights":{"changed":[{"id":1,"name":"Lamp","set":{"intensity":250.0}}]}})");
}

TEST(SceneEdits, MeshesAddedAreListedAsLeftOut) {
    const Project imported = sample_project().project;
    Scene other = imported.scene;
    for (const auto& [id, mesh] : imported.scene.meshes) {
        Mesh copy = mesh;
        for (MeshPart& part : copy.parts) part.geometry = std::make_shared<Geometry>(*part.geometry);
        other.meshes.set(id, copy);
    }
    const auto merged = blush::apply(imported, Import{other, "again"});
    ASSERT_TRUE(merged) << error_text(merged);
    const std::string text = edits_json(imported.scene, merged->scene);
    EXPECT_NE(text.find("\"left_out\":[\"mesh"), std::string::npos);
    const auto applied = apply_edits_json(imported.scene, text);
    ASSERT_TRUE(applied) << error_text(applied);
    EXPECT_EQ(applied->nodes.size(), merged->scene.nodes.size());
    EXPECT_EQ(applied->meshes, imported.scene.meshes);
}

TEST(SceneEdits, EnvironmentMapsAreReadAgain) {
    const TempFolder folder;
    ASSERT_TRUE(write_exr(folder / "sky.exr", LayeredImage{1, 1, {{"R", {1}}, {"G", {2}}, {"B", {3}}}, {}}));
    const Scene imported = sample_project().project.scene;
    Scene now = imported;
    now.environment.kind = Environment::Kind::image;
    now.environment.file = "sky.exr";
    now.environment.image = uniform_image(1, 1, 3, 0);
    const auto applied = apply_edits_json(imported, edits_json(imported, now), folder.path());
    ASSERT_TRUE(applied) << error_text(applied);
    EXPECT_EQ(applied->environment.image->floats, (std::vector<float>{1, 2, 3}));
    EXPECT_FALSE(apply_edits_json(imported, edits_json(imported, now), folder / "elsewhere"));
}

TEST(SceneEdits, WrongTextIsAnError) {
    const Scene scene = sample_project().project.scene;
    for (const char* text : {"",
                             "[]",
                             "{}",
                             R"({"format":2})",
                             R"({"format":1,"lights":3})",
                             R"({"format":1,"lights":{"changed":5}})",
                             R"({"format":1,"lights":{"changed":[{"id":99,"set":{}}]}})",
                             R"({"format":1,"lights":{"changed":[{"id":1,"set":{"colour":1}}]}})",
                             R"({"format":1,"lights":{"changed":[{"id":1,"set":{"kind":"laser"}}]}})",
                             R"({"format":1,"lights":{"changed":[{"id":1,"set":{"intensity":-1}}]}})",
                             R"({"format":1,"lights":{"changed":[{"id":1,"set":{"intensity":1e999}}]}})",
                             R"({"format":1,"lights":{"changed":[{"id":1,"set":{"color":[1,2]}}]}})",
                             R"({"format":1,"lights":{"changed":[7]}})",
                             R"({"format":1,"lights":{"removed":[99]}})",
                             R"({"format":1,"lights":{"added":[{"id":1,"set":{}}]}})",
                             R"({"format":1,"meshes":{"added":[{"id":9,"set":{}}]}})",
                             R"({"format":1,"meshes":{"changed":[{"id":1,"set":{"materials":[1]}}]}})",
                             R"({"format":1,"textures":{"added":[{"id":9,"set":{}}]}})",
                             R"({"format":1,"materials":{"removed":[1]}})",
                             R"({"format":1,"nodes":{"changed":[{"id":1,"set":{"parent":1}}]}})",
                             R"({"format":1,"environment":{"kind":"image"}})",
                             R"({"format":1,"view":[]})"}) {
        EXPECT_FALSE(apply_edits_json(scene, text)) << text;
    }
}

TEST(SceneHash, DiffersOnlyIfTheImageDiffers) {
    const Sample sample = sample_project();
    const Scene& scene = sample.project.scene;
    const std::string hash = scene_hash(scene);
    EXPECT_EQ(hash.size(), 16u);
    EXPECT_EQ(hash, scene_hash(sample_project().project.scene)) << "payload serials count";

    Scene renamed = scene;
    Material red = *scene.materials.find(sample.red);
    red.name = "Crimson";
    renamed.materials.set(sample.red, red);
    EXPECT_EQ(scene_hash(renamed), hash);

    Scene rougher = scene;
    red.roughness = std::nextafter(red.roughness, 0.0f);
    rougher.materials.set(sample.red, red);
    EXPECT_NE(scene_hash(rougher), hash);

    Scene moved = scene;
    moved.view.position.x += 1;
    EXPECT_NE(scene_hash(moved), hash);

    Scene repainted = scene;
    Texture checker = *scene.textures.find(sample.checker);
    checker.image = byte_image(2, 2, 3, 129);
    repainted.textures.set(sample.checker, checker);
    EXPECT_NE(scene_hash(repainted), hash);

    Scene reshaped = scene;
    Mesh quad = *scene.meshes.find(sample.quad);
    Geometry geometry = *quad.parts[0].geometry;
    geometry.positions[2].z += 1e-6f;
    quad.parts[0].geometry = std::make_shared<const Geometry>(geometry);
    reshaped.meshes.set(sample.quad, quad);
    EXPECT_NE(scene_hash(reshaped), hash);
}

// A light's IES profile is read again from its file, only in or below the scene's folder.
TEST(SceneEdits, IesProfilesAreStoredAsFileNames) {
    const std::filesystem::path folder = std::filesystem::path(BLUSH_ASSETS) / "ies";
    const Sample sample = sample_project();
    Scene now = sample.project.scene;
    Light lamp = *now.lights.find(sample.lamp);
    lamp.ies_file = "downlight.ies";
    lamp.ies = *read_ies(folder / lamp.ies_file);
    now.lights.set(sample.lamp, lamp);
    const std::string text = edits_json(sample.project.scene, now);
    EXPECT_EQ(text.find("left_out"), text.npos);
    const auto applied = apply_edits_json(sample.project.scene, text, folder);
    ASSERT_TRUE(applied) << error_text(applied);
    EXPECT_EQ(scene_hash(*applied), scene_hash(now));
    EXPECT_NE(scene_hash(*applied), scene_hash(sample.project.scene)) << "an IES profile is part of the scene";

    for (const char* file : {"../ies/downlight.ies", "/etc/passwd", "nowhere.ies", "file:downlight.ies"}) {
        std::string elsewhere = text;
        elsewhere.replace(elsewhere.find("downlight.ies"), 13, file);
        EXPECT_FALSE(apply_edits_json(sample.project.scene, elsewhere, folder)) << file;
    }
    lamp.ies_file = (folder / "downlight.ies").string();
    now.lights.set(sample.lamp, lamp);
    const std::string outside = edits_json(sample.project.scene, now);
    EXPECT_NE(outside.find("left_out"), outside.npos);
    EXPECT_TRUE(apply_edits_json(sample.project.scene, outside, folder));
}

} // namespace
} // namespace blush::test::TEST_FILE
