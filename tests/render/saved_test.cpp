// A scene that was saved and opened again gives the very same picture.
#include "io/gltf_import.h"
#include "io/gltf_save.h"
#include "io/ies.h"
#include "scenes.h"
#include "support/pictures.h"
#include "support/process.h"
#include "support/random_edits.h"
#include "support/sample_project.h"
#include "support/storable.h"

#include <gtest/gtest.h>

#include <fstream>

namespace blush::test {
namespace {

Frame picture(const Project& project) {
    RenderSettings settings = project.render;
    settings.width = 48;
    settings.height = 27;
    return fresh_picture(project.scene, settings, 2);
}

TEST(Saved, ScenesRenderBitForBitAsTheyWere) {
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
            EXPECT_TRUE(same_picture(picture(project), picture(again))) << file;
        }
    }
}

// One light of every kind, measured ones, links, groups and a mix of them, under an environment map.
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
    scene.environment.image = float_image(8, 4, 3, 0.3f);
    scene.environment.intensity = 0.7f;
    scene.environment.rotation_degrees = 33;
    scene.mix.grouping = LightMix::Grouping::by_hand;
    scene.mix.channels = {{.group = "Warm", .intensity = 0.6f, .color = {1, 0.8f, 0.7f}}, {.group = "light 5", .enabled = false}};
    scene.view.position = {0, 2, 5};
    scene.view.rotation = {-0.17f, 0, 0, 0.985f};
    return scene;
}

TEST(Saved, EveryKindOfLightRendersBitForBitAsItDid) {
    const TemporaryFolder folder;
    std::ofstream(folder / "empty.gltf") << R"({"asset": {"version": "2.0"}})";
    const auto original = import_gltf(folder / "empty.gltf");
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
        EXPECT_TRUE(same_picture(picture(project), picture({loaded->scene, {}, {}}))) << file;
    }
}

} // namespace
} // namespace blush::test
