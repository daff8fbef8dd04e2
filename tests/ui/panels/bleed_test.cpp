// The bleed panel: its jobs run only while it is open, it lists who lights the place, and drawing it edits nothing.
#include "render/renderer.h"
#include "scene/node_name.h"
#include "tests/support/eventually.h"
#include "tests/support/process.h"
#include "tests/support/sample_project.h"
#include "tests/ui/imgui_test.h"
#include "tests/ui/shipped_ocio_config.h"
#include "ui/panels/instruments.h"
#include "ui/panels/panels.h"
#include "ui/snapshots/aov_view.h"
#include "ui/snapshots/image_pixels.h"
#include "ui/snapshots/light_piles.h"
#include "ui/views/bleed_view.h"
#include "ui/window/ui_persistence.h"

#include <cmath>
#include <fstream>
#include <iterator>

namespace blush::TEST_FILE {
namespace {

// A wall beside a floor, in a sun and a sky.
Scene floor_and_wall() {
    Scene scene;
    const auto add = [&](const char* name, const Vec3& color, const Quat& rotation, const Vec3& translation) {
        Material material;
        material.base_color = color;
        material.metallic = 0;
        material.specular = 0;
        material.double_sided = true;
        MeshPart part;
        part.geometry = test::quad_geometry();
        part.material = scene.materials.add(material);
        Mesh mesh;
        mesh.parts.push_back(part);
        Node node;
        node.name = name;
        node.mesh = scene.meshes.add(std::move(mesh));
        node.local.rotation = rotation;
        node.local.translation = translation;
        return scene.nodes.add(node);
    };
    const float h = std::sqrt(0.5f);
    add("floor", {0.6f, 0.6f, 0.6f}, {-h, 0, 0, h}, {0, 0, 0});
    add("wall", {0.8f, 0.05f, 0.05f}, {0, 0, 0, 1}, {0, 0, -0.5f});
    scene.environment.kind = Environment::Kind::constant;
    scene.environment.intensity = 1;
    scene.view.position = {0, 1, 2};
    scene.view.rotation = {-std::sin(0.23f), 0, 0, std::cos(0.23f)};
    return scene;
}

class BleedPanel : public test::ImGuiTest {
protected:
    BleedPanel() {
        Project project;
        project.scene = floor_and_wall();
        project.render.width = 64;
        project.render.height = 48;
        document = Document(project);
        ui.probe = Probe(folder / "probe.json");
    }
    void draw() {
        ui.probe.begin_frame();
        in_window([&] {
            PanelContext c{document, ui, color, frame, SessionStatus(), 64, 48};
            draw_bleed_panel(c);
        });
        ui.probe.end_frame({});
    }
    bool shows(const std::string& widget) const {
        std::ifstream in(folder / "probe.json");
        const std::string text(std::istreambuf_iterator<char>(in), {});
        return text.find("\"" + widget + "\"") != text.npos;
    }
    void set_open(bool open) {
        PanelContext c{document, ui, color, frame, SessionStatus(), 64, 48};
        find_instrument(instruments(), "bleed")->set_open(c, open);
    }
    LightMeter on_the_floor() const {
        LightMeter point;
        point.position = {0, 0, -0.3f};
        point.clearance = 1e-5f;
        return point;
    }

    test::TemporaryFolder folder;
    const ColorManagement color = test::our_colors();
    Document document;
    UiState ui;
    FramePtr frame;
};

TEST_F(BleedPanel, MeasuresWhileItIsOpen) {
    const Project before = document.project();
    set_open(true);
    draw();
    EXPECT_FALSE(ui.bleed.runner) << "nothing to measure yet";
    ui.bleed.point = on_the_floor();
    ASSERT_TRUE(test::eventually([&] {
        draw();
        return ui.bleed.state.rests;
    }));
    const BleedReport& report = *ui.bleed.state.output;
    ASSERT_GE(report.senders.size(), 2u);
    EXPECT_EQ(report.senders[1].name, "wall");
    EXPECT_EQ(report.senders[1].shift.towards, "red");
    for (const char* widget : {"Bleed/Environment, direct", "Bleed/wall", "Bleed/Summary", "Bleed/Sentence"})
        EXPECT_TRUE(shows(widget)) << widget;
    EXPECT_TRUE(document.project() == before) << "drawing edits nothing";

    set_open(false);
    EXPECT_FALSE(ui.bleed.runner) << "costs nothing while closed";
    EXPECT_FALSE(ui.bleed.state.output);
}

TEST_F(BleedPanel, ListsLightsAndBounces) {
    set_open(true);
    ui.bleed.rect = ImageRegion{0.3f, 0.4f, 0.3f, 0.2f};
    for (const auto& [list, widget] :
         {std::pair{BleedView::List::lights, "Bleed/Environment"}, {BleedView::List::bounces, "Bleed/twice"}}) {
        ui.bleed.list = list;
        ASSERT_TRUE(test::eventually([&] {
            draw();
            return ui.bleed.state.output.has_value();
        }));
        draw();
        EXPECT_TRUE(shows(widget)) << widget;
    }
}

TEST_F(BleedPanel, StopsTheMapWhenItIsSwitchedOff) {
    set_open(true);
    ui.bleed.map = true;
    ASSERT_TRUE(test::eventually([&] {
        draw();
        return ui.bleed.map_state.output.passes > 0;
    }));
    EXPECT_EQ(ui.bleed.map_state.output.columns, 4);
    ui.bleed.map = false;
    draw();
    EXPECT_FALSE(ui.bleed.map_runner);
}

TEST_F(BleedPanel, FollowsThePlaceAndTheCameraOnlyWhereTheyMatter) {
    const Scene scene = floor_and_wall();
    Scene moved = scene;
    moved.view.position.x += 1;
    ui.bleed.point = on_the_floor();
    const RenderSettings settings = document.project().render;
    const auto input = [&](const Scene& s) { return BleedWork::Input(s, settings, target_of(ui.bleed, s, 64, 48)); };
    EXPECT_TRUE(input(scene).has_same_result(input(moved))) << "light that arrives";
    ui.bleed.quantity = BleedView::Quantity::leaving;
    EXPECT_FALSE(input(scene).has_same_result(input(moved)));
    EXPECT_TRUE(input(scene).has_same_result(input(scene)));
}

// A point is attached to a node, whose id means another one there.
TEST_F(BleedPanel, ForgetsThePlaceInAnotherScene) {
    ui.bleed.point = on_the_floor();
    restore_scene_ui({}, "/another.gltf", floor_and_wall(), ui);
    EXPECT_FALSE(ui.bleed.has_place());
}

// ---- the two piles, which the viewport shows

TEST(TwoPiles, SumToTheBeauty) {
    RenderSettings settings;
    settings.width = 48;
    settings.height = 32;
    PlaneSet planes;
    planes.bounces = default_bounce_planes;
    Renderer renderer({.threads = 2, .planes = planes});
    renderer.update(floor_and_wall(), settings);
    ASSERT_TRUE(renderer.render(0, 16));
    const Frame frame = renderer.resolve();
    // The sum of the planes is rounded once per plane.
    const float rounding = float(default_bounce_planes) * 0x1p-24f;
    bool bled = false;
    for (size_t i = 0; i < frame.rgba.size() / 4; ++i) {
        const TwoPiles piles = piles_of(frame, i);
        const Vec3 sum = piles.direct + piles.indirect;
        bled |= piles.indirect.x > 0 && piles.indirect.x > 1.5f * piles.indirect.y;
        for (const auto& [a, b] : {std::pair{sum.x, frame.rgba[4 * i]}, {sum.y, frame.rgba[4 * i + 1]}, {sum.z, frame.rgba[4 * i + 2]}})
            EXPECT_NEAR(a, b, rounding * b) << i;
    }
    EXPECT_TRUE(bled) << "the wall colours the floor";

    // Each part of the image shows its pile, up to its wipe.
    const std::vector<float> shown = pixels_of(frame, {.show = ImageView::Show::two_piles, .wipes = {0.25f, 0.75f}});
    for (size_t i = 0; i < frame.rgba.size() / 4; ++i) {
        const size_t x = i % 48;
        const TwoPiles piles = piles_of(frame, i);
        const Vec3 expected = x < 12 ? piles.direct : x < 36 ? piles.indirect : piles.direct + piles.indirect;
        EXPECT_EQ(shown[4 * i], expected.x) << i;
    }
}

// Black, blue, red, yellow, white: as the heat map of the share and of Delta E.
TEST(TwoPiles, AreMapsOfShareAndBleed) {
    using Show = ImageView::Show;
    Frame f;
    f.width = 8;
    f.height = 4;
    f.rgba.assign(4 * 32, 1);
    f.bounces.assign(3, std::vector<Vec3>(32, Vec3{0, 0, 0}));
    for (size_t i = 0; i < 32; ++i) {
        f.bounces[1][i] = {1, 1, 1};
        f.bounces[2][i] = i % 8 < 4 ? Vec3{1, 1, 1} : Vec3{0.5f, 0, 0};
    }
    const auto at = [&](Show show, size_t i) {
        const std::vector<float> p = pixels_of(f, {show});
        return Vec3{p[4 * i], p[4 * i + 1], p[4 * i + 2]};
    };
    EXPECT_EQ(at(Show::indirect_share, 0), at(Show::indirect_share, 9));
    EXPECT_NE(at(Show::indirect_share, 0), at(Show::indirect_share, 4));
    EXPECT_LT(at(Show::bleed, 0).x + at(Show::bleed, 0).y + at(Show::bleed, 0).z, 1e-3f) << "white on white bleeds nothing";
    EXPECT_GT(at(Show::bleed, 5).x, 0.1f) << "red on white does";
    for (const Show show : {Show::indirect_share, Show::bleed, Show::two_piles}) {
        EXPECT_TRUE(is_special(f, {show}));
        EXPECT_FALSE(is_special(Frame{}, {show}));
        EXPECT_FALSE(caption_of(f, {show}).empty());
        EXPECT_EQ(planes_of(AovView{show}).bounces, default_bounce_planes);
    }
}

} // namespace
} // namespace blush::TEST_FILE
