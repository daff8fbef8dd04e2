// Multi-selection, and multi-edit of lights.
#include "ui/lights/light_groups.h"
#include "ui/lights/light_tools.h"
#include "ui/lights/multi_edit.h"
#include "ui/window/ui_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush::TEST_FILE {
namespace {

using Ids = std::vector<Id<Node>>;

Scene three_nodes() {
    Scene scene;
    for (int i = 0; i < 3; ++i) scene.nodes.add({});
    return scene;
}

TEST(Selection, CtrlClickToggles) {
    const Scene scene = three_nodes();
    UiState ui;
    ui.select({1});
    ui.toggle({2});
    ui.toggle({3});
    EXPECT_EQ(ui.selection(scene), (Ids{{3}, {1}, {2}})) << "the last one is the active node";
    ui.toggle({1});
    EXPECT_EQ(ui.selection(scene), (Ids{{3}, {2}}));
    ui.toggle({3});
    EXPECT_EQ(ui.selection(scene), (Ids{{2}}));
    EXPECT_TRUE(ui.is_selected({2}));
    EXPECT_FALSE(ui.is_selected({3}));
    ui.toggle({2});
    EXPECT_TRUE(ui.selection(scene).empty());
    EXPECT_FALSE(ui.is_selected({}));
}

TEST(Selection, PlainClickReplacesAndDeletedNodesAreSkipped) {
    Scene scene = three_nodes();
    UiState ui;
    ui.select({1});
    ui.toggle({2});
    scene.nodes.remove({1});
    EXPECT_EQ(ui.selection(scene), (Ids{{2}}));
    ui.select({3});
    EXPECT_EQ(ui.selection(scene), (Ids{{3}}));
}

TEST(Selection, ShiftClickSelectsARange) {
    const Scene scene = three_nodes();
    const Ids listed{{3}, {1}, {2}};
    UiState ui;
    ui.select({2});
    ui.select_range(listed, {3});
    EXPECT_EQ(ui.selection(scene), (Ids{{2}, {3}, {1}}));
    ui.select_range(listed, {1});
    EXPECT_EQ(ui.selection(scene), (Ids{{2}, {1}})) << "from the anchor";
    ui.select({});
    ui.select_range(listed, {1});
    EXPECT_EQ(ui.selection(scene), (Ids{{1}}));
}

TEST(MultiEdit, CopiesFieldsExceptNameAndKeepsBalance) {
    Light before, after, other;
    other.name = "Fill";
    before.intensity = 10;
    other.intensity = 4;
    after = before;
    after.name = "Key";
    after.intensity = 20;
    after.color = {1, 0.5f, 0};
    after.group = "Warm";
    after.radius = 0.5f;
    const Light edited = apply_same_edit(other, before, after);
    EXPECT_EQ(edited.name, "Fill");
    EXPECT_EQ(edited.intensity, 8) << "by the same factor";
    EXPECT_EQ(edited.color, after.color);
    EXPECT_EQ(edited.group, "Warm");
    EXPECT_EQ(edited.radius, 0.5f);
    EXPECT_EQ(apply_same_edit(other, before, before), other) << "fields that are not edited stay";
}

TEST(MultiEdit, CopiesSizesOnlyBetweenLightsOfOneType) {
    Light before, after, sun;
    sun.kind = Light::Kind::sun;
    after.radius = 0.5f;
    after.kelvin = 3000;
    const Light edited = apply_same_edit(sun, before, after);
    EXPECT_EQ(edited.radius, sun.radius);
    EXPECT_EQ(edited.kelvin, 3000);
}

TEST(MultiEdit, IntensityFromZeroIsCopied) {
    Light before, after, other;
    before.intensity = 0;
    after.intensity = 5;
    other.intensity = 3;
    EXPECT_EQ(apply_same_edit(other, before, after).intensity, 5);
}

struct Rig {
    Scene scene;
    Id<Node> stand, key, fill;

    Rig() {
        stand = scene.nodes.add({});
        key = lamp("Key", stand);
        fill = lamp("Fill", {});
    }
    Id<Node> lamp(const char* name, Id<Node> parent) {
        Light light;
        light.name = name;
        Node node;
        node.parent = parent;
        node.light = scene.lights.add(light);
        return scene.nodes.add(node);
    }
};

TEST(MultiEdit, FindsLightsOfSubtreesOnce) {
    const Rig r;
    EXPECT_EQ(lights_of(r.scene, Ids{r.stand, r.key, r.fill, {99}}), (std::vector<Id<Light>>{{1}, {2}}));
    EXPECT_EQ(subtree_roots(r.scene, Ids{r.key, r.stand, r.fill}), (Ids{r.stand, r.fill}));
}

TEST(MultiEdit, IsOneStepWithOneEditPerChangedLight) {
    const Rig r;
    const std::vector<Id<Light>> lights{{1}, {2}};
    const auto mute = [](Light& light) { light.enabled = light.name == "Key"; };
    const std::vector<Edit> edits = change_lights(r.scene, lights, mute);
    EXPECT_EQ(edits.size(), 1u) << "Key is on already";
    Document document(Project{r.scene, {}, {}});
    ASSERT_TRUE(document.apply(edits, label_for("Mute", r.scene, lights, Ids{r.key, r.fill})));
    EXPECT_EQ(document.undo_label(), "Mute 2 lights");
    EXPECT_FALSE(document.project().scene.lights.find({2})->enabled);
    document.undo();
    EXPECT_TRUE(document.project().scene == r.scene);
}

TEST(MultiEdit, NamesALightAsTheOutlinerDoes) {
    Rig r;
    const std::vector<Id<Light>> key{{1}};
    EXPECT_EQ(label_for("Mute", r.scene, key, Ids{r.key}), "Mute light Key") << "the light's name, as the node has none";
    Node node = *r.scene.nodes.find(r.key);
    node.name = "Window left";
    r.scene.nodes.set(r.key, node);
    node.name = "Window right";
    const Id<Node> right = r.scene.nodes.add(node);
    EXPECT_EQ(label_for("Mute", r.scene, key, Ids{r.stand}), "Mute light Window left");
    EXPECT_EQ(label_for("Mute", r.scene, key, Ids{right}), "Mute light Window right");
    EXPECT_EQ(label_for("Mute", r.scene, key, {}), "Mute light Window left") << "it is not selected";
}

TEST(MultiEdit, ListsDifferingFields) {
    Rig r;
    const std::vector<Id<Light>> lights{{1}, {2}};
    EXPECT_TRUE(differing_fields(r.scene, lights).empty());
    Light fill = *r.scene.lights.find({2});
    fill.intensity = 7;
    fill.group = "Back";
    r.scene.lights.set({2}, fill);
    EXPECT_EQ(differing_fields(r.scene, lights), (std::vector<std::string>{"intensity", "group"}));
}

TEST(LightGroups, NewNamesAreUnique) {
    Rig r;
    EXPECT_TRUE(group_names(r.scene).empty());
    Light key = *r.scene.lights.find({1});
    key.group = "Group 1";
    r.scene.lights.set({1}, key);
    r.scene.environment.group = "Sky";
    EXPECT_EQ(group_names(r.scene), (std::vector<std::string>{"Group 1", "Sky"}));
    EXPECT_EQ(unused_group_name(r.scene), "Group 2");
}

TEST(EnvironmentRotation, FollowsTheMouse) {
    Lens lens;
    lens.yfov_radians = 1.2f;
    // One per cent of the image in its centre, as an angle.
    const double angle = std::atan(0.01 * 2 * std::tan(0.6)) * 180 / std::numbers::pi;
    EXPECT_NEAR(turned_rotation(10, 0.01, lens), 10 - angle, 1e-3) << "to the right is clockwise seen from above";
    EXPECT_NEAR(turned_rotation(-179, 0.1, lens), 173.2, 0.1) << "around";
}

} // namespace
} // namespace blush::TEST_FILE
