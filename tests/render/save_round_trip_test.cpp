// A scene that is saved and reopened renders bit-identically.
#include "io/gltf/read/import.h"
#include "io/gltf/write/save.h"
#include "io/image/ies.h"
#include "io/project/scene_hash.h"
#include "tests/render/scenes.h"
#include "tests/support/images.h"
#include "tests/support/process.h"
#include "tests/support/random_edits.h"
#include "tests/support/sample_project.h"
#include "tests/support/storable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

Frame rendered(const Project& project) {
    RenderSettings settings = project.render;
    settings.width = 48;
    settings.height = 27;
    return fresh_image(project.scene, settings, 2);
}

TEST(Saved, ScenesRenderBitForBitAsBefore) {
    const TemporaryFolder folder;
    Rng rng(8);
    for (const std::string& name : shipped_scene_names()) {
        const auto original = import_gltf(std::string(BLUSH_ASSETS) + "/scenes/" + name + ".gltf");
        ASSERT_TRUE(original);
        for (const char* extension : {"gltf", "glb"}) {
            Project project{original->scene, {}, {}};
            for (int step = 0; step < 10; ++step) project = *blush::apply(project, random_edit(rng, project));
            project = storable(project);
            const std::string file = folder / (name + "." + extension);
            const auto saved = save_gltf(original->origin, project, file);
            ASSERT_TRUE(saved) << saved.error().text();
            const auto loaded = import_gltf(file);
            ASSERT_TRUE(loaded) << loaded.error().text();
            const Project again{loaded->scene, loaded->render.value_or(RenderSettings{}), loaded->view.value_or(ViewSettings{})};
            EXPECT_TRUE(same_pixels(rendered(project), rendered(again))) << file;
        }
    }
}

// One light of every kind, IES lights, links, groups and a mix of them, under an environment map.
Scene desk() {
    Scene scene;
    Material clay, glow;
    clay.name = "clay";
    clay.metallic = 0;
    glow.name = "glow";
    glow.emissive = {1, 0.5f, 0.2f};
    Node ground;
    ground.mesh = scene.meshes.add({"ground", {{quad_geometry(), scene.materials.add(clay)}}});
    ground.local.rotation = {-0.70710678f, 0, 0, 0.70710678f};
    ground.local.scale = {6, 6, 6};
    const Id<Node> floor = scene.nodes.add(ground);
    Node ball = ground;
    ball.mesh = scene.meshes.add({"card", {{quad_geometry(), scene.materials.add(glow)}}});
    ball.local = {};
    ball.local.translation = {0, 1, -1};
    ball.local.scale = {0.5f, 0.5f, 0.5f};
    const Id<Node> card = scene.nodes.add(ball);
    const IesPtr downlight = *read_ies(std::string(BLUSH_ASSETS) + "/ies/downlight.ies");
    for (int i = 0; i < 8; ++i) {
        Light light;
        light.kind = Light::Kind(i % 6);
        light.name = "light " + std::to_string(i);
        light.radius = light.kind == Light::Kind::disk || light.kind == Light::Kind::sphere ? 0.2f : i == 1 ? 0.05f : 0;
        light.angle_radians = light.kind == Light::Kind::sun ? 0.1f : 0;
        light.intensity = light.kind == Light::Kind::sun ? 0.3f : 2.2f + 0.1f * float(i);
        light.color = {1, 0.9f, 0.1f * float(i)};
        light.use_temperature = i % 2;
        light.kelvin = 3000.f + 777.f * float(i);
        light.spread_radians = 2;
        light.inner_cone_radians = 0.3f;
        light.two_sided = i == 3;
        light.visible_to_camera = i != 4;
        light.group = i < 3 ? "Warm" : "";
        if (i >= 6) { // a point and a spot
            light.ies = downlight;
            light.ies_file = std::string(BLUSH_ASSETS) + "/ies/downlight.ies";
        }
        if (i == 2) light.lit_objects = {true, {card}};
        if (i == 3) light.shadow_casters = {false, {floor}};
        Node node;
        node.light = scene.lights.add(light);
        node.local.translation = {0.7f * float(i) - 2.5f, 1.5f + 0.1f * float(i), 0.3f};
        node.local.rotation = {-0.70710678f, 0, 0, 0.70710678f};
        scene.nodes.add(node);
    }
    scene.environment.kind = Environment::Kind::image;
    scene.environment.image = uniform_image(8, 4, 3, 0.3f);
    scene.environment.intensity = 0.7f;
    scene.environment.rotation_degrees = 33;
    scene.mix.grouping = LightMix::Grouping::by_hand;
    scene.mix.channels = {{.group = "Warm", .intensity = 0.6f, .color = {1, 0.8f, 0.7f}}, {.group = "light 5", .enabled = false}};
    scene.view.position = {0, 2, 5};
    scene.view.rotation = {-0.17f, 0, 0, 0.985f};
    return scene;
}

// An empty file, as a base for saving scenes.
Result<ImportedScene> import_empty(const TemporaryFolder& folder) {
    std::ofstream(folder / "empty.gltf") << R"({"asset": {"version": "2.0"}})";
    return import_gltf(folder / "empty.gltf");
}

TEST(Saved, EveryKindOfLightRendersBitForBitAsBefore) {
    const TemporaryFolder folder;
    const auto original = import_empty(folder);
    ASSERT_TRUE(original) << original.error().text();
    for (const char* extension : {"gltf", "glb"}) {
        const Project project{desk(), {}, {}};
        const std::string file = folder / (std::string("desk.") + extension);
        const auto saved = save_gltf(original->origin, project, file);
        ASSERT_TRUE(saved) << saved.error().text();
        for (const Diagnostic& d : saved->diagnostics) ADD_FAILURE() << d.what;
        const auto loaded = import_gltf(file);
        ASSERT_TRUE(loaded) << loaded.error().text();
        EXPECT_EQ(loaded->scene.lights.size(), 8u);
        EXPECT_TRUE(same_pixels(rendered(project), rendered({loaded->scene, {}, {}}))) << file;
    }
}

// A sphere with a texture that is mirrored in the middle, without tangents, as written by `save_gltf`.
std::string save_ball(const GltfOrigin& origin, const TemporaryFolder& folder) {
    Geometry g;
    constexpr uint32_t n = 12;
    constexpr float half_turn = std::numbers::pi_v<float>;
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i) {
            const float u = 2 * half_turn * float(i) / n, v = half_turn * (float(j) + 0.5f) / (n + 1);
            g.positions.push_back({std::sin(v) * std::cos(u), std::cos(v), std::sin(v) * std::sin(u)});
        }
    g.normals = g.positions;
    g.uv.resize(2);
    for (const Vec3& p : g.positions) {
        g.uv[0].push_back({std::abs(p.x), p.y});
        g.uv[1].push_back({p.z + 0.5f * p.y, std::abs(p.y)});
    }
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i) {
            const uint32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = c - 1;
            g.indices.insert(g.indices.end(), {a, b, c, a, c, d});
        }
    Scene scene;
    Material steel;
    steel.name = "steel";
    steel.roughness = 0.4f;
    Node ball;
    ball.mesh = scene.meshes.add({"ball", {{std::make_shared<const Geometry>(std::move(g)), scene.materials.add(steel)}}});
    scene.nodes.add(ball);
    scene.environment.kind = Environment::Kind::image;
    scene.environment.image = uniform_image(8, 4, 3, 0.3f);
    scene.view.position = {0, 0, 4};
    const std::string file = folder / "ball.gltf";
    const auto saved = save_gltf(origin, {scene, {}, {}}, file);
    EXPECT_TRUE(saved) << saved.error().text();
    return file;
}

// Anisotropy in the window looks like that of the saved file after reopening, whose import computes tangents.
TEST(Saved, TangentsAfterAnEditAreThoseOfTheReopenedFile) {
    const TemporaryFolder folder;
    const auto empty = import_empty(folder);
    ASSERT_TRUE(empty) << empty.error().text();
    const auto original = import_gltf(save_ball(empty->origin, folder));
    ASSERT_TRUE(original) << original.error().text();
    const auto geometry_of = [](const Scene& scene) { return scene.meshes.begin()->value.parts[0].geometry; };
    Project project{original->scene, {}, {}};
    EXPECT_TRUE(geometry_of(project.scene)->tangents.empty());
    const Frame before = rendered(project);
    auto [id, material] = *project.scene.materials.begin();
    material.anisotropy = 0.9f;
    project = *blush::apply(project, SetMaterial{id, material});
    EXPECT_FALSE(same_pixels(rendered(project), before));

    const std::string file = folder / "stretched.gltf";
    const auto saved = save_gltf(original->origin, project, file);
    ASSERT_TRUE(saved) << saved.error().text();
    const auto loaded = import_gltf(file);
    ASSERT_TRUE(loaded) << loaded.error().text();
    EXPECT_FALSE(geometry_of(loaded->scene)->tangents.empty());
    const size_t vertices = geometry_of(project.scene)->positions.size();
    EXPECT_GT(geometry_of(loaded->scene)->positions.size(), vertices) << "vertices on the mirror line are split";
    EXPECT_TRUE(same_pixels(rendered(project), rendered({loaded->scene, {}, {}})));
}

ImagePtr slanted_normal_map() {
    auto map = std::make_shared<Image>();
    map->width = map->height = 1;
    map->channels = 3;
    map->bytes = {220, 150, 200};
    return map;
}

// Imported tangents are for the UV set of the original normal map.
TEST(Saved, TangentsFollowTheNormalMapToAnotherUvSetAsInTheReopenedFile) {
    const TemporaryFolder folder;
    const auto empty = import_empty(folder);
    ASSERT_TRUE(empty) << empty.error().text();
    const auto smooth = import_gltf(save_ball(empty->origin, folder));
    ASSERT_TRUE(smooth) << smooth.error().text();
    Project project{smooth->scene, {}, {}};
    auto [id, material] = *project.scene.materials.begin();
    material.normal_texture.texture = project.scene.textures.add({"slanted", "", slanted_normal_map()});
    project.scene.materials.set(id, material);
    ASSERT_TRUE(save_gltf(smooth->origin, project, folder / "bumpy.gltf"));
    const auto bumpy = import_gltf(folder / "bumpy.gltf");
    ASSERT_TRUE(bumpy) << bumpy.error().text();
    const auto geometry_of = [](const Scene& scene) { return scene.meshes.begin()->value.parts[0].geometry; };
    ASSERT_TRUE(geometry_of(bumpy->scene)->generated_tangents);
    EXPECT_EQ(scene_hash(bumpy->scene), scene_hash(project.scene)) << "generated tangents are not part of the hash";
    project.scene = bumpy->scene;
    const Frame first = rendered(project);
    for (const int set : {1, 5, 0}) { // 5: which it does not have
        material.normal_texture.uv_set = uint8_t(set);
        project = *blush::apply(project, SetMaterial{id, material});
        EXPECT_EQ(same_pixels(rendered(project), first), set == 0);
        // Into the original file, and with newly written meshes, without tangents.
        for (const GltfOrigin* origin : {&bumpy->origin, &empty->origin}) {
            const std::string file = folder / (std::to_string(set) + (origin == &bumpy->origin ? "edited.gltf" : "written.gltf"));
            const auto saved = save_gltf(*origin, project, file);
            ASSERT_TRUE(saved) << saved.error().text();
            const auto loaded = import_gltf(file);
            ASSERT_TRUE(loaded) << loaded.error().text();
            EXPECT_EQ(loaded->origin.json->find("TANGENT"), std::string::npos);
            EXPECT_TRUE(same_pixels(rendered(project), rendered({loaded->scene, {}, {}}))) << file;
        }
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
