// Selection of clips, scenes and variants as undoable edits.
#include "scene/animation/pose.h"
#include "scene/animation/posed_scene.h"
#include "scene/document/document.h"
#include "scene/document/scene_selection.h"
#include "scene/world_transforms.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

using test::Sample;
using test::sample_project;

SceneSelection swing_at(const Sample& s, float seconds) { return {.clip = s.swing, .seconds = seconds}; }

TEST(SceneSelection, AClipMovesItsNodesAndTheirDescendants) {
    Sample s = sample_project();
    Document document(s.project);
    ASSERT_TRUE(document.apply(SetSceneSelection{swing_at(s, 1)}));
    const Scene& scene = document.project().scene;
    // Half way from (0, 0, 3) to (2, 0, 3).
    EXPECT_EQ(world_from_node(scene, s.lamp_node).t, (Vec3d{1, 0, 3}));
    EXPECT_EQ(scene.nodes, s.project.scene.nodes) << "nodes keep their rest transform";
    EXPECT_TRUE(is_animated(scene, s.lamp_node, Channel::Property::translation));
    EXPECT_FALSE(is_animated(scene, s.lamp_node, Channel::Property::rotation));
    EXPECT_FALSE(is_animated(s.project.scene, s.lamp_node, Channel::Property::translation)) << "at rest";
    EXPECT_EQ(world_from_node(scene, s.table), world_from_node(s.project.scene, s.table));

    const Scene applied = with_pose_applied(scene);
    EXPECT_EQ(applied.nodes.find(s.lamp_node)->local.translation, (Vec3{1, 0, 3}));
    for (const auto& [id, node] : scene.nodes) EXPECT_EQ(world_from_node(applied, id), world_from_node(scene, id)) << node.name;
}

TEST(SceneSelection, ADragOfTheTimeIsOneStepThatCanBeUndone) {
    Sample s = sample_project();
    Document document(s.project);
    constexpr Gesture drag = 7;
    for (const float t : {0.25f, 0.5f, 1.5f}) ASSERT_TRUE(document.apply(SetSceneSelection{swing_at(s, t)}, drag));
    EXPECT_EQ(document.undo_labels().size(), 1u);
    EXPECT_EQ(document.project().scene.scene_selection, swing_at(s, 1.5f));
    ASSERT_TRUE(document.undo());
    EXPECT_EQ(document.project(), s.project);
    ASSERT_TRUE(document.redo());
    EXPECT_EQ(document.project().scene.scene_selection, swing_at(s, 1.5f));
}

TEST(SceneSelection, NonFiniteAnimatedNodesAreHidden) {
    Sample s = sample_project();
    Scene& scene = s.project.scene;
    Clip clip = *scene.clips.find(s.swing);
    const auto keys = std::make_shared<const Keyframes>(Keyframes{Keyframes::Interpolation::step, {0}, {3e38f, 3e38f, 3e38f}});
    clip.channels = {{s.root, Channel::Property::scale, keys}, {s.mug, Channel::Property::scale, keys}};
    for (const Id<Node> id : {s.root, s.mug, s.lamp_node}) { // the product of so many of them
        Node node = *scene.nodes.find(id);
        node.local.scale = {3e38f, 3e38f, 3e38f};
        scene.nodes.set(id, node);
    }
    Node far = *scene.nodes.find(s.mug);
    for (int i = 0; i < 8; ++i) far.parent = scene.nodes.add(far);
    scene.nodes.set(s.mug, far);
    scene.clips.set(s.swing, clip);
    const Scene applied = with_pose_applied(with_scene_selection(scene, swing_at(s, 0)));
    EXPECT_FALSE(is_visible(applied, s.mug));
    EXPECT_TRUE(is_visible(applied, s.table));
}

TEST(SceneSelection, MissingChoicesAreRefused) {
    const Sample s = sample_project();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const SceneSelection& bad : {SceneSelection{.clip = Id<Clip>{99}}, swing_at(s, -1), swing_at(s, nan), SceneSelection{.scene = 1},
                                      SceneSelection{.scene = -1}, SceneSelection{.variant = 2}, SceneSelection{.variant = -2}})
        EXPECT_FALSE(blush::apply(s.project, SetSceneSelection{bad}));
}

TEST(SceneSelection, AViewThroughACameraFollowsIt) {
    Sample s = sample_project();
    Scene& scene = s.project.scene;
    Clip clip = *scene.clips.find(s.swing);
    clip.channels.push_back({s.camera_node, Channel::Property::translation, clip.channels.back().keyframes});
    std::ranges::sort(clip.channels, {}, [](const Channel& c) { return std::pair(c.node, c.property); });
    scene.clips.set(s.swing, clip);
    scene.view = view_through(scene, s.camera_node);
    const Scene moved = with_scene_selection(scene, swing_at(s, 1));
    EXPECT_EQ(moved.view.position, (Vec3{1, 0, 3}));
    scene.view.position.x += 1; // a free view
    EXPECT_EQ(with_scene_selection(scene, swing_at(s, 1)).view, scene.view);
}

TEST(SceneSelection, VariantsAssignAndKeepTheirMaterials) {
    Sample s = sample_project();
    Document document(s.project);
    const auto assigned_material = [&](size_t part) { return document.project().scene.meshes.find(s.quad)->parts[part].material; };
    ASSERT_TRUE(document.apply(SetSceneSelection{{.variant = 1}}));
    EXPECT_EQ(assigned_material(0), s.grey);
    EXPECT_EQ(assigned_material(1), s.grey) << "has no variants";
    ASSERT_TRUE(document.apply(SetSceneSelection{{.variant = 0}}));
    EXPECT_EQ(assigned_material(0), s.red) << "has none for this variant";

    // A material is assigned to the chosen variant if the part has a material for it.
    ASSERT_TRUE(document.apply(SetSceneSelection{{.variant = 1}}));
    const Id<Material> checker = document.project().scene.materials.begin()->id;
    ASSERT_TRUE(document.apply(AssignMaterial{s.quad, 0, checker}));
    ASSERT_TRUE(document.apply(SetSceneSelection{}));
    EXPECT_EQ(assigned_material(0), s.red);
    ASSERT_TRUE(document.apply(SetSceneSelection{{.variant = 1}}));
    EXPECT_EQ(assigned_material(0), checker);
    while (document.undo()) {}
    EXPECT_EQ(document.project(), s.project);
}

TEST(SceneSelection, OfSeveralScenesTheChosenOneShows) {
    Sample s = sample_project();
    Scene& scene = s.project.scene;
    scene.scene_names = {"Day", "Night"};
    Node root = *scene.nodes.find(s.root);
    root.only_in_scenes = {1};
    scene.nodes.set(s.root, root);
    EXPECT_FALSE(is_visible(scene, s.root));
    EXPECT_FALSE(is_visible(scene, s.mug)) << "is its child";
    EXPECT_FALSE(is_in_chosen_scene(scene, s.mug));
    EXPECT_TRUE(is_visible(scene, s.table)) << "in all of them";
    const Scene night = with_scene_selection(scene, {.scene = 1});
    EXPECT_TRUE(is_visible(night, s.mug));
    for (const Scene& whole : {scene, night})
        for (const auto& [id, node] : whole.nodes) EXPECT_EQ(is_visible(with_pose_applied(whole), id), is_visible(whole, id)) << node.name;
    // Import into another scene takes the chosen scene and variant.
    const Project merged = *blush::apply(sample_project().project, Import{scene, "day"});
    EXPECT_EQ(merged.scene.nodes.size(), 2 * scene.nodes.size() - 3) << "without root, mug and lamp";
}

} // namespace
} // namespace blush::TEST_FILE
