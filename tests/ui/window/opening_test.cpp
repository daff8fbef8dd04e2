// Opening a file: auto exposure for the subject, home camera, and camera frame.
#include "render/film/crop.h"
#include "scene/document/document.h"
#include "scene/geometry/ground_plane.h"
#include "tests/support/sample_project.h"
#include "tests/ui/shipped_ocio_config.h"
#include "ui/lights/light_presence.h"
#include "ui/viewport/camera_frame.h"
#include "ui/viewport/region_backdrop.h"
#include "ui/views/home_view.h"
#include "ui/views/subject_exposure.h"
#include "ui/window/file_places.h"

#include "io/image/display_image.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>

#include <cmath>

namespace blush::TEST_FILE {
namespace {

// Objects on the left half, background on the right; both uniformly grey.
Frame halves(float object, float backdrop) {
    Frame f;
    f.width = 80;
    f.height = 48;
    for (int i = 0; i < f.width * f.height; ++i) {
        const bool is_object = i % f.width < f.width / 2;
        const float grey = is_object ? object : backdrop;
        f.rgba.insert(f.rgba.end(), {grey, grey, grey, 1});
        f.object_id.push_back(is_object ? 1 : 0);
        f.depth.push_back(is_object ? 2.f : 0.f);
    }
    return f;
}

class SubjectExposure : public testing::Test {
protected:
    ColorManagement color = test::our_colors();
    Scene scene;
    std::optional<float> metered(const Frame& f, std::vector<Id<Node>> selected = {}) {
        return subject_exposure(f, scene, selected, {}, color);
    }
    // Mean of the display-encoded image.
    double shown_mean(const Frame& f, float exposure_ev) {
        std::vector<float> rgb;
        for (size_t i = 0; i < f.rgba.size(); i += 4) rgb.insert(rgb.end(), {f.rgba[i], f.rgba[i + 1], f.rgba[i + 2]});
        ViewSettings view;
        view.exposure_ev = exposure_ev;
        EXPECT_TRUE(show(color, view, rgb));
        double sum = 0;
        for (const float x : rgb) sum += x;
        return sum / double(rgb.size());
    }
};

TEST_F(SubjectExposure, ObjectsBecomeMiddleGreyWithAnyBackground) {
    for (const float grey : {1e-4f, 0.18f, 3000.f}) {
        const Frame black = halves(grey, 0), same = halves(grey, grey);
        ASSERT_TRUE(metered(black));
        EXPECT_NEAR(*metered(black), std::log2(0.18f / grey), 1e-3);
        EXPECT_NEAR(*metered(same), std::log2(0.18f / grey), 1e-3);
        const double mean = shown_mean(same, *metered(same));
        EXPECT_GT(mean, 0.1);
        EXPECT_LT(mean, 0.6);
    }
    EXPECT_FALSE(metered(halves(0, 1))) << "a black object cannot be metered";
}

TEST_F(SubjectExposure, BrightBackgroundLowersItByOneAndAHalfStopsAtMost) {
    const float alone = *metered(halves(0.18f, 0)), beside = *metered(halves(0.18f, 1000));
    EXPECT_NEAR(beside, alone - 1.5f, 1e-3);
}

TEST_F(SubjectExposure, DarkSubjectWithBrightBackgroundIsLimited) {
    const Frame f = halves(0.02f, 0.3f); // the background is close to display white, but not clipped
    EXPECT_GT(shown_mean(f, *metered(halves(0.02f, 0))), 0.6);
    EXPECT_LE(shown_mean(f, *metered(f)), 0.56);
    EXPECT_GT(shown_mean(f, *metered(f)), 0.45);
}

TEST_F(SubjectExposure, UsesTheSelection) {
    Node node;
    node.mesh = scene.meshes.add({});
    const Id<Node> first = scene.nodes.add(node), second = scene.nodes.add(node);
    Frame f = halves(0.5f, 0.001f);
    for (size_t i = 0; i < f.object_id.size(); ++i) f.object_id[i] = f.object_id[i] ? first.value : second.value;
    EXPECT_NEAR(*metered(f, {first}), std::log2(0.18f / 0.5f), 1e-3);
    // The selection would be clipped; the whole image can lower the exposure by at most 1.5 stops.
    EXPECT_LE(*metered(f, {second}), std::log2(0.18f / 0.001f) + 1e-3);
    EXPECT_GE(*metered(f, {second}), std::log2(0.18f / 0.001f) - 1.5f - 1e-3);
}

TEST_F(SubjectExposure, UsesWhatIsInFocus) {
    Frame f = halves(0.02f, 0.3f);
    for (size_t i = 0; i < f.object_id.size(); ++i) {
        if (f.object_id[i] == 0) f.depth[i] = 50;
        f.object_id[i] = 1;
    }
    scene.view.lens.aperture_radius = 0.05f;
    scene.view.lens.focus_distance = 50;
    EXPECT_NEAR(*metered(f), std::log2(0.18f / 0.3f), 1e-3);
    scene.view.lens.focus_distance = 2;
    EXPECT_NEAR(*metered(f), std::log2(0.18f / 0.02f), 1.5f + 1e-3);
}

TEST(DocumentMeter, IsNoUndoStep) {
    const test::Sample s = test::sample_project();
    Document document(s.project);
    document.meter(3, true);
    EXPECT_FALSE(document.can_undo());
    EXPECT_FALSE(document.modified());
    EXPECT_EQ(document.project().view.exposure_ev, 3);
    Environment sky = s.project.scene.environment;
    sky.kind = Environment::Kind::sky;
    ASSERT_TRUE(document.apply(SetEnvironment{sky}));
    document.meter(-9, false);
    document.undo();
    EXPECT_EQ(document.project().view.exposure_ev, 3) << "undone together with its edit";
    document.redo();
    EXPECT_EQ(document.project().view.exposure_ev, -9);
}

TEST(CameraFrame, ImageAndFrameHaveTheAspect) {
    CameraFrame frame;
    EXPECT_EQ(image_size(frame, 900, 600).width, 900);
    frame.aspect = 1;
    EXPECT_EQ(image_size(frame, 900, 600).width, 900) << "extends beyond the frame";
    const ImageRect inside = frame_in_image(frame, {10, 20, 900, 600});
    EXPECT_EQ(inside.width, 600);
    EXPECT_EQ(inside.x, 160);
    frame.fit = true;
    EXPECT_EQ(image_size(frame, 900, 600).width, 600);
    EXPECT_EQ(image_size(frame, 900, 600).height, 600);
    frame = {.aspect = 2, .from_file = {}};
    EXPECT_EQ(image_size(frame, 900, 600).height, 450) << "wider than the window: fully visible";
    EXPECT_EQ(frame_in_image(frame, {0, 0, 900, 450}).width, 900);
}

TEST(CameraFrame, AspectIsFromTheSettingsElseFromTheFile) {
    Scene scene;
    Node node;
    node.camera = scene.cameras.add({"camera", {}});
    const Id<Node> id = scene.nodes.add(node);
    CameraFrame frame{.from_file = {{node.camera, 1.5f}}};
    ViewSettings view;
    settle(frame, view, scene, id);
    EXPECT_EQ(frame.aspect, 1.5f);
    EXPECT_FALSE(frame.lock);
    view.frame_aspect = 2.f;
    view.lock_camera = true;
    settle(frame, view, scene, id);
    EXPECT_EQ(frame.aspect, 2);
    EXPECT_TRUE(frame.lock);
    view.frame_aspect = 0.f;
    settle(frame, view, scene, id);
    EXPECT_EQ(frame.aspect, 0) << "no frame, even if the file has one";
}

// Each pixel of the planes holds its own index.
Frame numbered_frame(int width, int height) {
    Frame f;
    f.width = width;
    f.height = height;
    for (int i = 0; i < width * height; ++i) {
        for (int c = 0; c < 4; ++c) f.rgba.push_back(float(i));
        f.albedo.push_back({float(i), 0, 0});
        f.depth.push_back(float(i));
        f.object_id.push_back(uint32_t(i));
    }
    f.bounces = {f.albedo};
    f.error.known = true;
    return f;
}

TEST(CameraFrame, CropsAllPlanes) {
    const Frame part = cropped(numbered_frame(5, 3), {1, 0, 4, 3});
    EXPECT_EQ(part.width, 3);
    EXPECT_EQ(part.height, 3);
    EXPECT_EQ(part.depth, (std::vector<float>{1, 2, 3, 6, 7, 8, 11, 12, 13}));
    EXPECT_EQ(part.rgba.size(), 36u);
    EXPECT_EQ(part.rgba[4 * 4], 7);
    EXPECT_EQ(part.object_id[8], 13u);
    EXPECT_EQ(part.bounces[0][3].x, 6);
    EXPECT_TRUE(part.normal.empty());
    EXPECT_FALSE(part.error.known) << "it is that of the whole image";
    EXPECT_EQ(cropped(DenoisedPtr(), {0, 0, 1, 1}), nullptr);
}

TEST(RegionBackdrop, SurroundTheRegion) {
    float area = 0;
    for (const ImageRegion& part : around({0.25f, 0.5f, 0.5f, 0.25f})) area += part.width * part.height;
    EXPECT_FLOAT_EQ(area, 1 - 0.5f * 0.25f);
    for (const ImageRegion& part : around({})) EXPECT_EQ(part.width * part.height, 0);
}

TEST(HomeView, IsTheCameraOfTheView) {
    Scene scene;
    const Id<Camera> camera = scene.cameras.add({"camera", {}});
    Node node;
    node.camera = camera;
    node.local.translation = {0, 0, 3};
    const Id<Node> first = scene.nodes.add(node);
    node.local.translation = {4, 0, 3};
    const Id<Node> second = scene.nodes.add(node);
    scene.view = view_through(scene, second);
    const HomeView home = home_at_opening(scene);
    EXPECT_EQ(home.camera, second);
    EXPECT_TRUE(is_at_home(scene, home));
    scene.view.position.x += 1;
    EXPECT_FALSE(is_at_home(scene, home));
    EXPECT_EQ(home_view(scene, home).position.x, 4);
    EXPECT_EQ(home_at_opening(scene).camera, first) << "a free view: the first camera";
    scene.nodes.remove(second);
    EXPECT_TRUE(is_at_home(scene, home)) << "the camera was deleted";
}

TEST(LightPresence, MutedLightsCount) {
    Scene scene;
    LightPresence presence;
    Node node;
    node.mesh = scene.meshes.add({});
    scene.nodes.add(node);
    EXPECT_FALSE(presence.in(scene));
    Light lamp;
    lamp.enabled = false;
    Node holder;
    holder.light = scene.lights.add(lamp);
    scene.nodes.add(holder);
    EXPECT_TRUE(presence.in(scene));
}

TEST(GroundPlane, IsJustBelowTheModel) {
    Bounds box;
    box.include({-1, 2, -1});
    box.include({3, 4, 1});
    const Scene ground = ground_plane_under(box);
    const Bounds plane = world_bounds(ground);
    EXPECT_LT(plane.high.y, 2);
    EXPECT_GT(plane.high.y, 1.99);
    EXPECT_LT(plane.low.x, -10);
    EXPECT_NEAR(plane.center().x, 1, 1e-5);
}

TEST(FilePlaces, ListsExistingFoldersOnce) {
    const test::TemporaryFolder temporary;
    const std::filesystem::path folder = temporary.path();
    std::filesystem::create_directories(folder / "scenes");
    WindowSettings settings;
    settings.recent = {(folder / "scenes" / "a.gltf").string(), (folder / "scenes" / "b.gltf").string(),
                       (folder / "gone" / "c.gltf").string()};
    settings.bookmarks = {folder.string()};
    size_t scenes = 0, gone = 0, bookmarks = 0;
    for (const FilePlace& place : file_places(settings, folder / "scenes")) {
        scenes += place.folder == folder / "scenes";
        gone += place.folder == folder / "gone";
        bookmarks += place.bookmark;
    }
    EXPECT_EQ(scenes, 1u);
    EXPECT_EQ(gone, 0u);
    EXPECT_EQ(bookmarks, 1u);
}

} // namespace
} // namespace blush::TEST_FILE
