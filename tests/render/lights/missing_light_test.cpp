// Light that no strategy can find is reported, and the agreement of two halves that both miss it does not make the error known.
#include "render/lights/missing_light.h"

#include "render/compile/expanded_lights.h"
#include "render/renderer.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <gtest/gtest.h>

namespace blush::test::TEST_FILE {
namespace {

Light lamp(Light::Kind kind, float size) {
    Light light;
    light.kind = kind;
    light.radius = light.angle_radians = size;
    light.intensity = 5;
    return light;
}

struct Room {
    Scene scene;
    std::vector<Id<Material>> used;

    void put(const Material& material) {
        const Id<Node> node = place(scene, floor_quad(50, 1), material);
        used.push_back(scene.meshes.find(scene.nodes.find(node)->mesh)->parts[0].material);
    }
};
std::string said(const Material& material, const Light& light, CausticFinders finders = CausticFinders::none) {
    Room room;
    room.put(lambert(0.5f));
    room.put(material);
    place_light(room.scene, light, aimed({0, 3, 0}, {0, -1, 0}));
    return missing_light(room.scene, nodes_with_lights(room.scene), smooth_surfaces(room.scene, room.used), finders);
}

TEST(MissingLight, IsThatOfZeroSizeLightsAtSmoothSurfaces) {
    Material pane = window_glass(), coated = lambert(0.5f);
    pane.specular = 0;
    coated.clearcoat = 1;
    Material rough_coat = coated;
    rough_coat.clearcoat_roughness = 0.1f;
    for (const Light::Kind kind : {Light::Kind::point, Light::Kind::spot, Light::Kind::sun}) {
        EXPECT_TRUE(said(glass(0, 1.5f), lamp(kind, 0)).starts_with("some light cannot be found"));
        EXPECT_NE(said(glass(0, 1.5f), lamp(kind, 0)).find("through smooth glass"), std::string::npos);
        EXPECT_NE(said(metal(0), lamp(kind, 0)).find("by reflection"), std::string::npos);
        EXPECT_NE(said(coated, lamp(kind, 0)).find("by reflection"), std::string::npos);
        EXPECT_EQ(said(rough_coat, lamp(kind, 0)), "");
        EXPECT_NE(said(metal(0), lamp(kind, 0), CausticFinders::light_paths)
                      .find("caustics of point, spot and sun lights of zero size, where they are seen in smooth"),
                  std::string::npos);
        EXPECT_EQ(said(glass(0, 1.5f), lamp(kind, 0.1f), CausticFinders::light_paths), "");
        EXPECT_EQ(said(pane, lamp(kind, 0)).find("through"), std::string::npos) << "light passes panes";
        EXPECT_EQ(said(glass(0, 1.5f), lamp(kind, 0.1f)), "") << "rays can hit lights with a size";
        EXPECT_EQ(said(glass(0.3f, 1.5f), lamp(kind, 0)), "") << "NEE finds it through rough lobes";
        EXPECT_EQ(said(lambert(0.5f), lamp(kind, 0)), "");
        Light muted = lamp(kind, 0);
        muted.enabled = false;
        EXPECT_EQ(said(metal(0), muted), "");
    }
    EXPECT_EQ(said(metal(0), lamp(Light::Kind::rectangle, 0)), "");
}

// A floor under a glass block and a parallel sun, with direct light only: black, and the error is unknown.
TEST(MissingLight, IsReportedWithTheFrameAndItsError) {
    Room room;
    place(room.scene, floor_quad(50), lambert(0.5f));
    place(room.scene, cube(false), glass(0, 1.5f), at({0, 2, 0}));
    Light sun = lamp(Light::Kind::sun, 0);
    place_light(room.scene, sun, aimed({0, 5, 0}, {0, -1, 0}));
    room.scene.view = looking_down(0.5f, 0.5f); // the sun's shadow of the cube
    RenderSettings settings = settings_for(16, 16, 16);
    settings.max_bounces = 1;
    Renderer renderer({.threads = 1, .planes = {}});
    renderer.update(room.scene, settings);
    renderer.render(0, 16);
    const Frame frame = renderer.resolve();
    EXPECT_FALSE(frame.missing_light.empty());
    EXPECT_FALSE(frame.error.known);
    EXPECT_FALSE(frame.error.rmse_known);
    const auto& warnings = renderer.info().warnings;
    EXPECT_TRUE(std::ranges::any_of(warnings, [&](const Diagnostic& d) { return d.what == frame.missing_light; }));
}

TEST(MissingLight, IsOnSurfacesThatTransmitLightRoughly) {
    Material frosted = glass(0.3f, 1.5f), paper = lambert(0.5f), half_clear = glass(0, 1.5f);
    paper.diffuse_transmission = half_clear.transmission = 0.5f;
    for (const CausticFinders finders : {CausticFinders::manifolds, CausticFinders::light_paths_and_manifolds})
        for (const Material& receiver : {lambert(0.5f), metal(0.3f), glass(0, 1.5f), frosted, paper, half_clear}) {
            Room room;
            room.put(glass(0, 1.5f));
            room.put(receiver);
            place_light(room.scene, lamp(Light::Kind::point, 0), at({0, 3, 0}));
            const std::string missing =
                missing_light(room.scene, nodes_with_lights(room.scene), smooth_surfaces(room.scene, room.used), finders);
            const bool begins_none = receiver == frosted || receiver == paper || receiver == half_clear;
            EXPECT_EQ(missing.find("are on rough glass or translucent surfaces, or come by way") != std::string::npos, begins_none)
                << missing;
        }
}

// Each strategy that finds a part of it makes the message shorter.
TEST(MissingLight, IsWhatTheStrategiesOfTheImageDoNotFind) {
    Scene scene;
    place(scene, floor_quad(2), lambert(0.5f));
    place(scene, sphere(false), metal(0), at({0, 0.5f, 0}, 0.5f));
    place_light(scene, lamp(Light::Kind::point, 0), at({1, 2, 0.5f}));
    scene.view = looking({0, 2, 4}, {0, 0.3f, 0}, 0.6f);
    const auto missing = [&](CausticStrategy caustics) {
        RenderSettings settings = settings_for(64, 36, 2);
        settings.caustics = caustics;
        Renderer renderer({.threads = 2});
        renderer.update(scene, settings);
        renderer.render(0, 2);
        return renderer.resolve().missing_light;
    };
    const std::string end = "; give these lights a radius or an angle, or the material some roughness",
                      by_light_paths =
                          "some light cannot be found: caustics of point, spot and sun lights of zero size, where they are seen "
                          "in smooth surfaces";
    EXPECT_EQ(missing(CausticStrategy::off),
              "some light cannot be found: that of point, spot and sun lights of zero size, by reflection in smooth surfaces" + end);
    EXPECT_EQ(missing(CausticStrategy::light_paths), by_light_paths + end);
    EXPECT_EQ(missing(CausticStrategy::manifold),
              "some light cannot be found: caustics of point, spot and sun lights of zero size that come by way of more than six "
              "surfaces, or by partial reflections within glass" +
                  end);
    EXPECT_EQ(missing(CausticStrategy::automatic),
              by_light_paths + " and come by way of more than six surfaces, or by partial reflections within glass" + end);
}

} // namespace
} // namespace blush::test::TEST_FILE
