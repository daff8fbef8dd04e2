#include "app/common/scene_overrides.h"
#include "io/image/image_io.h"
#include "tests/support/process.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

using test::Sample;
using test::sample_project;

TEST(Environment, ReadsWhatTheManualShows) {
    EXPECT_EQ(parse_environment("none")->kind, Environment::Kind::none);
    const EnvironmentChoice constant = *parse_environment("constant=0.5,1,2");
    EXPECT_EQ(constant.kind, Environment::Kind::constant);
    EXPECT_EQ(constant.color, (Vec3{0.5f, 1, 2}));
    const EnvironmentChoice file = *parse_environment("maps/a,b.exr,intensity=2,rotate=-90");
    EXPECT_EQ(file.kind, Environment::Kind::image);
    EXPECT_EQ(file.file, "maps/a,b.exr");
    EXPECT_EQ(file.intensity, 2);
    EXPECT_EQ(file.rotation_degrees, -90);
    EXPECT_EQ(*parse_environment("maps/a,b.exr,rotate=-90,intensity=2"), file);
    EXPECT_EQ(parse_environment("constant=1,1,1,intensity=3")->intensity, 3);
}

TEST(Environment, BadTextIsRefused) {
    for (const char* bad : {"", "constant=", "constant=1,2", "constant=1,2,x", "constant=1,2,3,4",
                            "a.exr,intensity=", "a.exr,intensity=much", "a.exr,rotate=inf"})
        EXPECT_FALSE(parse_environment(bad)) << bad;
}

// The sample scene with a second camera, called "2", to the right.
Sample two_cameras() {
    Sample s = sample_project();
    Node second = *s.project.scene.nodes.find(s.camera_node);
    second.name = "2";
    second.local.translation = {3, 0, 0};
    s.project.scene.nodes.add(second);
    return s;
}

float eye_x_of(const std::string& camera) {
    Scene scene = two_cameras().project.scene;
    const Result<void> applied = apply_overrides({.camera = camera}, scene, 1);
    EXPECT_TRUE(applied) << applied.error().text();
    return scene.view.position.x;
}

TEST(Overrides, CamerasAreFoundByNameOrNumber) {
    EXPECT_EQ(eye_x_of("Camera"), 0);
    EXPECT_EQ(eye_x_of("0"), 0);
    EXPECT_EQ(eye_x_of("1"), 3);
    EXPECT_EQ(eye_x_of("2"), 3) << "a name before a number";
    Scene scene = two_cameras().project.scene;
    EXPECT_EQ(apply_overrides({.camera = "5"}, scene, 1).error().text(), "there is no camera \"5\" (there are \"Camera\", \"2\")");
}

TEST(Overrides, TheNameOfTheCameraIsFound) {
    Scene scene = two_cameras().project.scene;
    ASSERT_TRUE(apply_overrides({.camera = "1", .aperture = 0.1f}, scene, 1));
    EXPECT_EQ(camera_name(scene), "2");
    scene.view.position.y += 1;
    EXPECT_EQ(camera_name(scene), "");
}

TEST(Overrides, WithoutACameraTheSceneIsFramed) {
    Sample s = sample_project();
    s.project = *blush::apply(s.project, RemoveNode{s.camera_node});
    Scene scene = s.project.scene;
    ASSERT_TRUE(apply_overrides({}, scene, 2));
    EXPECT_EQ(scene.view, framed(s.project.scene.view, world_bounds(scene), 2));
    EXPECT_EQ(apply_overrides({.camera = "A"}, scene, 1).error().text(), "there is no camera \"A\": the scene has none");
}

TEST(Overrides, AnimationsScenesAndVariantsAreFoundByNameOrNumber) {
    Sample s = sample_project();
    s.project.scene.scene_names = {"Day", "Night"};
    const auto scene_selection = [&](const SceneSelectionOptions& choice) {
        Scene scene = s.project.scene;
        const Result<void> applied = apply_overrides({.scene_selection = choice}, scene, 1);
        EXPECT_TRUE(applied) << applied.error().text();
        return scene.scene_selection;
    };
    EXPECT_EQ(scene_selection({}), SceneSelection{});
    EXPECT_EQ(scene_selection({.animation = "Swing", .seconds = 1.5f}), (SceneSelection{.clip = s.swing, .seconds = 1.5f}));
    EXPECT_EQ(scene_selection({.animation = "0"}), (SceneSelection{.clip = s.swing}));
    EXPECT_EQ(scene_selection({.scene = "Night"}).scene, 1);
    EXPECT_EQ(scene_selection({.variant = "All grey"}).variant, 1);
    s.project.scene.scene_selection = {.clip = s.swing, .seconds = 1, .variant = 1};
    EXPECT_EQ(scene_selection({.seconds = 0.5f}), (SceneSelection{.clip = s.swing, .seconds = 0.5f, .variant = 1}))
        << "of the file's choice";
    EXPECT_EQ(scene_selection({.animation = "none", .variant = "none"}), SceneSelection{});
}

TEST(Overrides, UnknownChoicesAreErrors) {
    const auto error = [](const SceneSelectionOptions& choice) {
        Scene scene = sample_project().project.scene;
        const Result<void> applied = apply_overrides({.scene_selection = choice}, scene, 1);
        return applied ? "" : applied.error().text();
    };
    EXPECT_EQ(error({.animation = "Jump"}), "there is no animation \"Jump\" (there are \"Swing\")");
    EXPECT_EQ(error({.scene = "1"}), "there is no scene \"1\" (the file has none)");
    EXPECT_EQ(error({.variant = "Blue"}), "there is no variant of materials \"Blue\" (there are \"As it is\", \"All grey\")");
    EXPECT_EQ(error({.seconds = 1.f}), "--animation-time needs --animation");
    EXPECT_FALSE(error({.animation = "Swing", .seconds = -1.f}).empty());
}

// The camera has its animated transform.
TEST(Overrides, CamerasUseTheAnimatedPose) {
    Sample s = sample_project();
    Clip clip = *s.project.scene.clips.find(s.swing);
    clip.channels.push_back({s.camera_node, Channel::Property::translation, clip.channels.back().keyframes});
    s.project.scene.clips.set(s.swing, clip);
    Scene scene = s.project.scene;
    ASSERT_TRUE(apply_overrides({.camera = "Camera", .scene_selection = {.animation = "Swing", .seconds = 1.f}}, scene, 1));
    EXPECT_EQ(scene.view.position, (Vec3{1, 0, 3}));
}

TEST(Overrides, LensAndEnvironment) {
    Scene scene = sample_project().project.scene;
    ASSERT_TRUE(
        apply_overrides({.environment = *parse_environment("constant=1,2,3,intensity=2"), .aperture = 0.25f, .focus = 7}, scene, 1));
    EXPECT_EQ(scene.view.lens.aperture_radius, 0.25f);
    EXPECT_EQ(scene.view.lens.focus_distance, 7);
    EXPECT_EQ(scene.environment.kind, Environment::Kind::constant);
    EXPECT_EQ(scene.environment.color, (Vec3{1, 2, 3}));
    EXPECT_EQ(scene.environment.intensity, 2);
    ASSERT_TRUE(apply_overrides({.environment = EnvironmentChoice{}}, scene, 1));
    EXPECT_EQ(scene.environment.kind, Environment::Kind::none);
    EXPECT_FALSE(apply_overrides({.focus = -1}, scene, 1));
    EXPECT_FALSE(apply_overrides({.environment = *parse_environment("constant=-1,0,0")}, scene, 1));
}

TEST(Overrides, EnvironmentMapsAreRead) {
    const test::TemporaryFolder folder;
    LayeredImage map{.width = 4, .height = 2, .channels = {}, .metadata = {}};
    for (const char* name : {"R", "G", "B"}) map.channels.push_back({name, std::vector<float>(8, 1.5f)});
    ASSERT_TRUE(write_exr(folder / "sky.exr", map));
    Scene scene;
    ASSERT_TRUE(apply_overrides({.environment = *parse_environment((folder / "sky.exr") + ",rotate=30")}, scene, 1));
    ASSERT_TRUE(scene.environment.image);
    EXPECT_EQ(scene.environment.image->width, 4);
    EXPECT_EQ(scene.environment.rotation_degrees, 30);
    const Result<void> missing = apply_overrides({.environment = *parse_environment(folder / "none.exr")}, scene, 1);
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().text().find("none.exr"), std::string::npos);
}

} // namespace
} // namespace blush::TEST_FILE
