#include "io/image/image_io.h"
#include "tests/io/gltf/builder.h"

#include <gtest/gtest.h>

#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

void add_light(GltfBuilder& b, Json light) {
    Json& lights = b.json["extensions"]["KHR_lights_punctual"]["lights"];
    lights.push_back(std::move(light));
    b.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}}}});
}
Light import_light(Json light) {
    GltfBuilder b;
    add_light(b, std::move(light));
    const auto imported = import_built(b);
    EXPECT_TRUE(imported) << error_text(imported);
    if (!imported) return {};
    EXPECT_EQ(imported->scene.nodes.begin()->value.light, imported->scene.lights.begin()->id);
    return imported->scene.lights.begin()->value;
}

TEST(GltfLights, PunctualLightsKeepTheirUnits) {
    const Light point = import_light({{"type", "point"}, {"name", "Bulb"}, {"color", {1, 0.5, 0.25}}, {"intensity", 80}});
    EXPECT_EQ(point.kind, Light::Kind::point);
    EXPECT_EQ(point.name, "Bulb");
    EXPECT_EQ(point.color, (Vec3{1, 0.5f, 0.25f}));
    EXPECT_EQ(point.intensity, 80);
    const Light spot = import_light({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}});
    EXPECT_EQ(spot.kind, Light::Kind::spot);
    EXPECT_EQ(spot.inner_cone_radians, 0.1f);
    EXPECT_EQ(spot.outer_cone_radians, 0.5f);
    EXPECT_EQ(spot.intensity, 1);
    EXPECT_EQ(import_light({{"type", "directional"}, {"intensity", 100000}}).kind, Light::Kind::sun);
}

TEST(GltfLights, ExtrasGiveThemSize) {
    const Light sun = import_light({{"type", "directional"}, {"extras", {{"blush", {{"angle_degrees", 0.5}}}}}});
    EXPECT_FLOAT_EQ(sun.angle_radians, float(0.5 * std::numbers::pi / 180));
    EXPECT_EQ(import_light({{"type", "point"}, {"extras", {{"blush", {{"radius", 0.25}}}}}}).radius, 0.25f);
    const Light rectangle =
        import_light({{"type", "spot"},
                      {"spot", Json::object()},
                      {"extras", {{"blush", {{"rectangle", {{"width", 2.0}, {"height", 0.5}, {"two_sided", true}}}}}}}});
    EXPECT_EQ(rectangle.kind, Light::Kind::rectangle);
    EXPECT_EQ(rectangle.width, 2);
    EXPECT_EQ(rectangle.height, 0.5f);
    EXPECT_TRUE(rectangle.two_sided);
}

TEST(GltfLights, UnknownTypesAndRangesAreReported) {
    GltfBuilder b;
    add_light(b, {{"type", "laser"}});
    add_light(b, {{"type", "point"}, {"range", 5.0}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_EQ(imported->scene.lights.size(), 1u);
    EXPECT_TRUE(reports(imported->report, "unknown light type 'laser'"));
    EXPECT_TRUE(reports(imported->report, "light's range"));
    b.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 9}}}}}});
    EXPECT_NE(error_text(import_built(b)).find("light 9 does not exist"), std::string::npos);
}

GltfBuilder with_environment(Json environment) {
    GltfBuilder b;
    b.json["scenes"].push_back({{"nodes", Json::array()}, {"extras", {{"blush", {{"environment", std::move(environment)}}}}}});
    return b;
}

TEST(GltfEnvironment, ConstantFromExtras) {
    const auto imported = import_built(with_environment(
        {{"kind", "constant"}, {"color", {0.25, 0.5, 1.0}}, {"intensity", 3.0}, {"rotation_degrees", 45.0}, {"visible_to_camera", false}}));
    ASSERT_TRUE(imported) << error_text(imported);
    const Environment& e = imported->scene.environment;
    EXPECT_EQ(e.kind, Environment::Kind::constant);
    EXPECT_EQ(e.color, (Vec3{0.25f, 0.5f, 1}));
    EXPECT_EQ(e.intensity, 3);
    EXPECT_EQ(e.rotation_degrees, 45);
    EXPECT_FALSE(e.visible_to_camera);
}

TEST(GltfEnvironment, ImageBesideTheScene) {
    const TempFolder folder;
    LayeredImage map{2, 1, {{"R", {1, 2}}, {"G", {3, 4}}, {"B", {5, 6}}}, {}};
    ASSERT_TRUE(write_exr(folder / "sky.exr", map));
    const auto imported = import_text(folder, with_environment({{"kind", "image"}, {"file", "sky.exr"}}).gltf());
    ASSERT_TRUE(imported) << error_text(imported);
    const Environment& e = imported->scene.environment;
    EXPECT_EQ(e.kind, Environment::Kind::image);
    EXPECT_EQ(e.file, "sky.exr");
    ASSERT_TRUE(e.image);
    EXPECT_EQ(e.image->floats, (std::vector<float>{1, 3, 5, 2, 4, 6}));
}

TEST(GltfEnvironment, MissingImageIsAWarningAndOneOutsideAnError) {
    const auto missing = import_built(with_environment({{"kind", "image"}, {"file", "none.exr"}}));
    ASSERT_TRUE(missing) << error_text(missing);
    EXPECT_EQ(missing->scene.environment.kind, Environment::Kind::constant);
    EXPECT_TRUE(reports(missing->report, "environment map not read"));
    EXPECT_NE(error_text(import_built(with_environment({{"kind", "image"}, {"file", "../sky.exr"}}))).find("leaves the scene's folder"),
              std::string::npos);
}

} // namespace
} // namespace blush::test::TEST_FILE
