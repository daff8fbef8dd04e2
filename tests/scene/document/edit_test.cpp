#include "scene/document/edit.h"
#include "scene/document/subtree_edits.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

#include <limits>

namespace blush::TEST_FILE {
namespace {

using test::Sample;
using test::sample_project;
using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

AssertionResult refused(const Project& project, const Edit& edit, const std::string& words) {
    const Result<Project> next = blush::apply(project, edit);
    if (next) return AssertionFailure() << "the edit was accepted";
    if (next.error().text().find(words) == std::string::npos) return AssertionFailure() << "the error says: " << next.error().text();
    return AssertionSuccess();
}

TEST(Apply, RefusesIdsThatDoNotExist) {
    const Project p = sample_project().project;
    EXPECT_TRUE(refused(p, SetNode{{99}, {}}, "no node 99"));
    EXPECT_TRUE(refused(p, SetMaterial{{99}, {}}, "no material 99"));
    EXPECT_TRUE(refused(p, SetLight{{99}, {}}, "no light 99"));
    EXPECT_TRUE(refused(p, SetCamera{{99}, {}}, "no camera 99"));
    EXPECT_TRUE(refused(p, SetTexture{{99}, {}}, "no texture 99"));
    EXPECT_TRUE(refused(p, AssignMaterial{{99}, 0, {}}, "no mesh 99"));
    EXPECT_TRUE(refused(p, DuplicateNode{{99}}, "no node 99"));
    EXPECT_TRUE(refused(p, RemoveNode{{99}}, "no node 99"));
    EXPECT_TRUE(refused(p, LookThrough{{99}}, "no node 99"));
}

TEST(Apply, RefusesDanglingReferences) {
    const Sample s = sample_project();
    Node node = *s.project.scene.nodes.find(s.mug);
    node.mesh = {99};
    EXPECT_TRUE(refused(s.project, SetNode{s.mug, node}, "no mesh 99, node \"Mug\""));
    Material material;
    material.name = "M";
    material.normal_texture.texture = {99};
    EXPECT_TRUE(refused(s.project, SetMaterial{s.red, material}, "no normal texture 99, material \"M\""));
    EXPECT_TRUE(refused(s.project, AssignMaterial{s.quad, 0, {99}}, "no material 99, mesh \"Quad\""));
    EXPECT_TRUE(refused(s.project, AssignMaterial{s.quad, 2, s.red}, "no part 2"));
    EXPECT_TRUE(refused(s.project, AssignMaterial{s.quad, -1, s.red}, "no part -1"));
    Node below;
    below.parent = {99};
    EXPECT_TRUE(refused(s.project, AddLight{below, {}}, "no parent node 99"));
    EXPECT_TRUE(refused(s.project, LookThrough{s.mug}, "the node has no camera"));
}

TEST(Apply, RefusesCycles) {
    const Sample s = sample_project();
    Node root = *s.project.scene.nodes.find(s.root);
    root.parent = s.root;
    EXPECT_TRUE(refused(s.project, SetNode{s.root, root}, "its own ancestor"));
    root.parent = s.mug;
    EXPECT_TRUE(refused(s.project, SetNode{s.root, root}, "its own ancestor"));
}

TEST(Apply, RefusesValuesOutOfRange) {
    const Sample s = sample_project();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    Node node = *s.project.scene.nodes.find(s.mug);
    node.local.translation.y = nan;
    EXPECT_TRUE(refused(s.project, SetNode{s.mug, node}, "translation must be a finite number"));
    Material material;
    material.roughness = 1.5f;
    EXPECT_TRUE(refused(s.project, SetMaterial{s.red, material}, "roughness must be from 0 to 1, not 1.5"));
    Light light;
    light.intensity = -1;
    EXPECT_TRUE(refused(s.project, SetLight{s.lamp, light}, "intensity"));
    EXPECT_TRUE(refused(s.project, SetLens{{.yfov_radians = 0}}, "field of view"));
    EXPECT_TRUE(refused(s.project, SetRender{{.width = 0}}, "width must be from 1 to 65536, not 0"));
    EXPECT_TRUE(refused(s.project, SetView{{.gamma = 0}}, "gamma"));
}

TEST(Apply, AddLightPutsTheLightOnItsNode) {
    const Sample s = sample_project();
    Light light;
    light.intensity = 7;
    Node node;
    node.parent = s.root;
    const Scene scene = blush::apply(s.project, AddLight{node, light})->scene;
    const Node& added = scene.nodes.entries().back().value;
    EXPECT_EQ(added.parent, s.root);
    ASSERT_TRUE(scene.lights.contains(added.light));
    EXPECT_EQ(*scene.lights.find(added.light), light);
}

TEST(Apply, DuplicateCopiesLightsAndSharesMeshes) {
    const Sample s = sample_project();
    const Scene scene = blush::apply(s.project, DuplicateNode{s.root})->scene;
    ASSERT_EQ(scene.nodes.size(), s.project.scene.nodes.size() + 3);
    const auto copy = scene.nodes.end() - 3;
    EXPECT_EQ(copy[0].value.name, "Root 2");
    EXPECT_EQ(copy[0].value.parent, Id<Node>{});
    EXPECT_EQ(copy[1].value.parent, copy[0].id);
    EXPECT_EQ(copy[1].value.mesh, s.quad);
    EXPECT_EQ(copy[1].value.name, "Mug");
    EXPECT_NE(copy[2].value.light, s.lamp);
    EXPECT_EQ(*scene.lights.find(copy[2].value.light), *scene.lights.find(s.lamp));
    EXPECT_TRUE(scene.meshes.shares_storage(s.project.scene.meshes));
    const Scene again = blush::apply({scene, {}, {}}, DuplicateNode{copy[0].id})->scene;
    EXPECT_EQ((again.nodes.end() - 3)->value.name, "Root 3");
}

TEST(Apply, RemoveDeletesExactlyTheSubtree) {
    const Sample s = sample_project();
    const Scene scene = blush::apply(s.project, RemoveNode{s.root})->scene;
    EXPECT_FALSE(scene.nodes.contains(s.root));
    EXPECT_FALSE(scene.nodes.contains(s.mug));
    EXPECT_FALSE(scene.nodes.contains(s.lamp_node));
    EXPECT_TRUE(scene.nodes.contains(s.table));
    EXPECT_TRUE(scene.lights.contains(s.lamp)) << "records stay, so that undo and other users find them";
}

TEST(Apply, ImportKeepsTheImportedTreeTogether) {
    const Sample s = sample_project();
    const Scene scene = blush::apply(s.project, Import{s.project.scene, "twice"})->scene;
    const size_t n = s.project.scene.nodes.size();
    ASSERT_EQ(scene.nodes.size(), 2 * n);
    for (size_t i = 0; i < n; ++i) {
        const auto& [old_id, old_node] = scene.nodes.entries()[i];
        const auto& [new_id, new_node] = scene.nodes.entries()[n + i];
        EXPECT_EQ(new_node.name, old_node.name);
        EXPECT_EQ(world_from_node(scene, new_id), world_from_node(scene, old_id));
        EXPECT_EQ(bool(new_node.parent), bool(old_node.parent));
        if (new_node.parent) { EXPECT_NE(new_node.parent, old_node.parent); }
    }
    const Mesh& mesh = scene.meshes.entries().back().value;
    const Material* red = scene.materials.find(mesh.parts[0].material);
    ASSERT_TRUE(red);
    EXPECT_NE(mesh.parts[0].material, s.red);
    EXPECT_EQ(red->name, "Red");
    EXPECT_EQ(red->base_color_texture.texture, scene.textures.entries().back().id);
    EXPECT_EQ(scene.environment, s.project.scene.environment);
}

// Other objects with the same material or mesh do not become emissive.
TEST(Apply, MakeEmissiveTouchesOneObjectAlone) {
    const Sample s = sample_project();
    const Scene once = blush::apply(s.project, MakeEmissive{s.mug, 50})->scene;
    const Mesh& mesh = *once.meshes.find(once.nodes.find(s.mug)->mesh);
    for (const MeshPart& part : mesh.parts) {
        EXPECT_FALSE(s.project.scene.materials.contains(part.material)) << "a copy";
        EXPECT_EQ(once.materials.find(part.material)->emissive_strength, 50);
        EXPECT_EQ(once.materials.find(part.material)->emissive, (Vec3{1, 1, 1}));
    }
    for (const auto& [id, material] : s.project.scene.materials) EXPECT_EQ(*once.materials.find(id), material);

    const Project twins = *blush::apply(s.project, DuplicateNode{s.mug});
    const Id<Mesh> shared = twins.scene.nodes.find(s.mug)->mesh;
    const Scene one_shines = blush::apply(twins, MakeEmissive{s.mug, 50})->scene;
    EXPECT_NE(one_shines.nodes.find(s.mug)->mesh, shared);
    EXPECT_EQ(*one_shines.meshes.find(shared), *twins.scene.meshes.find(shared));

    EXPECT_TRUE(refused(s.project, MakeEmissive{s.root, 50}, "no mesh"));
    EXPECT_TRUE(refused(s.project, MakeEmissive{{99}, 50}, ""));
    EXPECT_TRUE(refused(s.project, MakeEmissive{s.mug, -1}, "emissive strength"));
}

TEST(Apply, ImportFindsParentsThatComeLater) {
    Scene other;
    Node child, parent;
    child.name = "child";
    parent.name = "parent";
    const Id<Node> child_id = other.nodes.add(child);
    const Id<Node> parent_id = other.nodes.add(parent);
    child.parent = parent_id;
    other.nodes.set(child_id, child);
    const Scene scene = blush::apply(sample_project().project, Import{other, ""})->scene;
    const auto last = scene.nodes.end() - 1;
    EXPECT_EQ(last->value.name, "parent");
    EXPECT_EQ((last - 1)->value.parent, last->id);
}

TEST(Apply, ImportRefusesABrokenScene) {
    Scene other;
    const Id<Node> a = other.nodes.add({});
    Node node;
    node.name = "loop";
    node.parent = a;
    other.nodes.set(a, node);
    EXPECT_TRUE(refused(sample_project().project, Import{other, ""}, "its own ancestor, node \"loop\""));
}

TEST(Subtree, ListsParentsBeforeChildren) {
    const Sample s = sample_project();
    EXPECT_EQ(subtree(s.project.scene, s.root), (std::vector{s.root, s.mug, s.lamp_node}));
    EXPECT_TRUE(subtree(s.project.scene, {99}).empty());
}

} // namespace
} // namespace blush::TEST_FILE
