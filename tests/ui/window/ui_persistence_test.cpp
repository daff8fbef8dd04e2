// Saved UI state of panels and scenes.
#include "ui/window/ui_persistence.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

TEST(UiPersistence, PanelsRoundTrip) {
    UiState ui;
    ui.tab = InspectorTab::render;
    ui.denoise = {DenoiseView::Show::blend, 0.25f};
    ui.snapshots.open = false;
    ui.snapshots.compare.kind = DifferenceKind::flip;
    ui.bounces.mode = BouncesView::Mode::cumulative;
    ui.bounces.bounce = 3;
    ui.bounces.gains = {1, 0, 2.5f};
    ui.convergence.targets = {0.5f, 0.01f};
    WindowSettings settings;
    settings.panels["section.Light"] = 0;
    save_panels(ui, settings);
    UiState again;
    restore_panels(settings, again);
    EXPECT_EQ(again.tab, InspectorTab::render);
    EXPECT_EQ(again.denoise, ui.denoise);
    EXPECT_FALSE(again.snapshots.open);
    EXPECT_EQ(again.snapshots.compare.kind, DifferenceKind::flip);
    EXPECT_EQ(again.bounces.mode, BouncesView::Mode::cumulative);
    EXPECT_EQ(again.bounces.bounce, 3);
    EXPECT_EQ(again.bounces.gains, ui.bounces.gains);
    EXPECT_EQ(again.convergence.targets, ui.convergence.targets);
    WindowSettings twice = settings;
    save_panels(again, twice);
    EXPECT_EQ(twice, settings);
    again.bounces.gains.pop_back();
    save_panels(again, twice);
    UiState fewer;
    restore_panels(twice, fewer);
    EXPECT_EQ(fewer.bounces.gains, again.bounces.gains) << "a removed gain is not kept";
}

TEST(UiPersistence, InvalidValuesAreIgnored) {
    WindowSettings settings;
    settings.panels = {{"tab", 99},           {"denoise", -1},    {"denoise.blend", 7}, {"bounces.bounce", 1e30},
                       {"bounces.gain.0", 5}, {"denoise", 1e300}, {"unknown", 3}};
    UiState ui;
    restore_panels(settings, ui);
    WindowSettings now, defaults;
    save_panels(ui, now);
    save_panels(UiState(), defaults);
    EXPECT_EQ(now, defaults);
}

struct TwoNodes {
    Scene scene;
    Id<Node> first = scene.nodes.add(Node()), second = scene.nodes.add(Node());
    Id<Material> material = scene.materials.add(Material());
};

TEST(UiPersistence, SceneStateRoundTrips) {
    const TwoNodes s;
    UiState ui;
    ui.zoom = {3, 0.25, 0.75};
    ui.toggle(s.first);
    ui.toggle(s.second);
    ui.selected_material = s.material;
    ui.turned = {s.first};
    ui.light_mix.unfolded = "Sun";
    ui.docks.open = {"scopes"};
    ui.farm.scene_file = "/a.gltf";
    ui.farm.plans = {{.folder = "/plan-1"}, {.folder = "/plan-2", .state = FarmPlan::State::making}};
    ui.farm.in_strip["/plan-1"] = 64;
    WindowSettings settings;
    save_scene_ui(ui, "/a.gltf", settings);
    EXPECT_EQ(settings.scenes[0].instruments, (std::vector<std::string>{"scopes"}));
    EXPECT_EQ(settings.scenes[0].plans, (std::vector<PlanMemory>{{"/plan-1", 64}})) << "one that is being made is none yet";
    ui.zoom = {};
    ui.select({});
    ui.turned.clear();
    ui.light_mix.unfolded.clear();
    save_scene_ui(ui, "/b.gltf", settings);
    EXPECT_TRUE(settings.scenes[0].plans.empty()) << "they are of another scene";
    restore_scene_ui(settings, "/a.gltf", s.scene, ui);
    EXPECT_EQ(ui.zoom, (ImageZoom{3, 0.25, 0.75}));
    EXPECT_EQ(ui.selection(s.scene), (std::vector{s.second, s.first}));
    EXPECT_EQ(ui.selected_material, s.material);
    EXPECT_EQ(ui.turned, (std::set{s.first}));
    EXPECT_EQ(ui.light_mix.unfolded, "Sun");
    restore_scene_ui(settings, "/b.gltf", s.scene, ui);
    EXPECT_EQ(ui.zoom, ImageZoom());
    EXPECT_TRUE(!ui.selected && !ui.selected_material && ui.turned.empty() && ui.light_mix.unfolded.empty());
    restore_scene_ui(settings, "/a.gltf", Scene(), ui);
    EXPECT_TRUE(!ui.selected && ui.also_selected.empty() && !ui.selected_material && ui.turned.empty()) << "deleted nodes";
    restore_scene_ui(settings, "/never.gltf", s.scene, ui);
    EXPECT_EQ(ui.zoom, ImageZoom());
}

TEST(UiPersistence, OnlyTheLastScenesAreKept) {
    WindowSettings settings;
    for (int i = 0; i < 30; ++i) save_scene_ui(UiState(), std::to_string(i % 15) + ".gltf", settings);
    EXPECT_EQ(settings.scenes.size(), remembered_files);
    EXPECT_EQ(settings.scenes[0].file, "14.gltf");
}

} // namespace
} // namespace blush::TEST_FILE
