// Reloading a changed file keeps local edits, matched by name and path, and reports conflicts.
#include "io/project/merge_edits.h"
#include "scene/document/document.h"
#include "scene/validate.h"
#include "tests/support/random_edits.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>
#include <map>

namespace blush::test::TEST_FILE {
namespace {

// A room with a lamp on a stand and a vase. `shift` records of each kind are added first, so that ids differ.
struct File {
    Scene scene;
    Id<Node> stand, lamp, vase;
    Id<Light> light;
    Id<Material> clay;

    explicit File(int shift = 0) {
        for (int i = 0; i < shift; ++i) {
            scene.nodes.add({.name = "New " + std::to_string(i)});
            scene.materials.add({.name = "New " + std::to_string(i)});
            scene.lights.add({.name = "New " + std::to_string(i)});
        }
        Geometry g;
        g.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        g.indices = {0, 1, 2};
        Material material;
        material.name = "Clay";
        clay = scene.materials.add(material);
        const Id<Mesh> mesh = scene.meshes.add({"Vase", {{std::make_shared<const Geometry>(g), clay}}});
        Light bulb;
        bulb.name = "Bulb";
        bulb.intensity = 5;
        light = scene.lights.add(bulb);
        stand = scene.nodes.add({.name = "Stand"});
        Node node{.name = "Lamp"};
        node.parent = stand;
        node.light = light;
        lamp = scene.nodes.add(node);
        Node pot{.name = "Vase"};
        pot.mesh = mesh;
        vase = scene.nodes.add(pot);
    }
    void brighten(float intensity) {
        Light l = *scene.lights.find(light);
        l.intensity = intensity;
        scene.lights.set(light, l);
    }
    void tint(const Vec3& color) {
        Material m = *scene.materials.find(clay);
        m.base_color = color;
        scene.materials.set(clay, m);
    }
    void move(Id<Node> id, const Vec3& to) {
        Node n = *scene.nodes.find(id);
        n.local.translation = to;
        scene.nodes.set(id, n);
    }
};

// Channels may name nodes that were removed since; they do nothing.
Table<Clip> clips_that_move_something(const Scene& scene) {
    Table<Clip> clips;
    for (auto [id, clip] : scene.clips) {
        std::erase_if(clip.channels, [&](const Channel& channel) { return !scene.nodes.contains(channel.node); });
        clips.insert(id, clip);
    }
    return clips;
}

// The merge drops links to objects that edits removed; renderers ignore them.
Table<Light> without_links_to_removed_objects(const Scene& scene) {
    Table<Light> lights = scene.lights;
    for (auto [id, light] : scene.lights) {
        for (ObjectSet* set : {&light.lit_objects, &light.shadow_casters})
            std::erase_if(set->nodes, [&](Id<Node> node) { return !scene.nodes.contains(node); });
        lights.set(id, std::move(light));
    }
    return lights;
}

// Merging into an unchanged file gives back every edit.
TEST(MergeEdits, IntoAnUnchangedFileAppliesTheEdits) {
    const Project imported = sample_project().project;
    Rng rng(5);
    for (int sequence = 0; sequence < 50; ++sequence) {
        Document document(imported);
        for (int i = 0; i < 12; ++i) (void)document.apply(random_edit(rng, document.project()));
        const Scene& mine = document.project().scene;
        const MergedEdits merged = merge_edits(imported.scene, mine, imported.scene);
        EXPECT_TRUE(merged.conflicts.empty()) << merged.conflicts.front();
        EXPECT_TRUE(merged.scene.nodes == mine.nodes) << sequence;
        EXPECT_TRUE(merged.scene.meshes == mine.meshes) << sequence;
        EXPECT_TRUE(merged.scene.materials == mine.materials) << sequence;
        EXPECT_TRUE(merged.scene.textures == mine.textures) << sequence;
        EXPECT_TRUE(merged.scene.lights == without_links_to_removed_objects(mine)) << sequence;
        EXPECT_TRUE(merged.scene.cameras == mine.cameras) << sequence;
        EXPECT_TRUE(merged.scene.skins == mine.skins) << sequence;
        EXPECT_TRUE(clips_that_move_something(merged.scene) == clips_that_move_something(mine)) << sequence;
        EXPECT_TRUE(merged.scene.scene_selection == mine.scene_selection) << sequence;
        EXPECT_TRUE(merged.scene.environment == mine.environment) << sequence;
        EXPECT_TRUE(merged.scene.mix == mine.mix) << sequence;
        EXPECT_TRUE(merged.scene.view == mine.view) << sequence;
    }
}

TEST(MergeEdits, FindRecordsByNameWhereverTheyAreNow) {
    const File base;
    File mine, theirs(3);
    mine.brighten(80);
    mine.move(mine.lamp, {1, 2, 3});
    mine.tint({1, 0, 0});
    theirs.move(theirs.vase, {7, 0, 0});
    const auto [scene, conflicts] = merge_edits(base.scene, mine.scene, theirs.scene);
    EXPECT_TRUE(conflicts.empty()) << conflicts.front();
    EXPECT_EQ(scene.lights.find(theirs.light)->intensity, 80);
    EXPECT_EQ(scene.nodes.find(theirs.lamp)->local.translation, (Vec3{1, 2, 3}));
    EXPECT_EQ(scene.nodes.find(theirs.lamp)->parent, theirs.stand);
    EXPECT_EQ(scene.materials.find(theirs.clay)->base_color, (Vec3{1, 0, 0}));
    EXPECT_EQ(scene.nodes.find(theirs.vase)->local.translation, (Vec3{7, 0, 0})) << "the file's own change";
    EXPECT_EQ(scene.nodes.size(), theirs.scene.nodes.size());
}

TEST(MergeEdits, ConflictsKeepMineAndAreReported) {
    const File base;
    File mine, theirs(1);
    mine.brighten(80);
    theirs.brighten(40);
    mine.tint({1, 0, 0});
    theirs.tint({1, 0, 0}); // the same on both sides is no conflict
    const auto [scene, conflicts] = merge_edits(base.scene, mine.scene, theirs.scene);
    EXPECT_EQ(scene.lights.find(theirs.light)->intensity, 80);
    EXPECT_EQ(conflicts, std::vector<std::string>{"light \"Bulb\": \"intensity\" changed here and in the file; yours is kept"});
}

TEST(MergeEdits, AddWhatWasAddedAndRemoveWhatWasRemoved) {
    const File base;
    File mine, theirs(2);
    Light rim;
    rim.name = "Rim";
    Node carrier{.name = "Rim"};
    carrier.light = mine.scene.lights.add(rim);
    carrier.parent = mine.stand;
    mine.scene.nodes.add(carrier);
    mine.scene.nodes.remove(mine.vase);
    const auto [scene, conflicts] = merge_edits(base.scene, mine.scene, theirs.scene);
    EXPECT_TRUE(conflicts.empty());
    EXPECT_FALSE(scene.nodes.contains(theirs.vase));
    const auto added = std::ranges::find_if(scene.nodes, [](const auto& entry) { return entry.value.name == "Rim"; });
    ASSERT_NE(added, scene.nodes.end());
    EXPECT_EQ(added->value.parent, theirs.stand);
    EXPECT_EQ(scene.lights.find(added->value.light)->name, "Rim");
}

TEST(MergeEdits, ReportEditsOfRemovedRecords) {
    const File base;
    File mine, theirs(1);
    mine.brighten(80);
    mine.move(mine.lamp, {1, 1, 1});
    theirs.scene.nodes.remove(theirs.lamp);
    theirs.scene.lights.remove(theirs.light);
    const auto [scene, conflicts] = merge_edits(base.scene, mine.scene, theirs.scene);
    EXPECT_EQ(scene.nodes.size(), theirs.scene.nodes.size());
    ASSERT_EQ(conflicts.size(), 2u);
    EXPECT_EQ(conflicts[0], "object \"Stand/Lamp\" was removed from the file; its edits are lost");
    EXPECT_TRUE(validate(scene));
}

// Nodes added below a removed node are removed with it; no dangling references.
TEST(MergeEdits, LeaveNoDanglingReferences) {
    const File base;
    File mine, theirs(1);
    Node child{.name = "Child"};
    child.parent = mine.stand;
    mine.scene.nodes.add(child);
    theirs.scene.nodes.remove(theirs.lamp);
    theirs.scene.nodes.remove(theirs.stand);
    const auto [scene, conflicts] = merge_edits(base.scene, mine.scene, theirs.scene);
    EXPECT_TRUE(validate(scene));
    // Random edits on both sides never give an invalid scene.
    const Project imported = sample_project().project;
    Rng rng(8);
    for (int i = 0; i < 100; ++i) {
        Document here(imported), there(imported);
        for (int k = 0; k < 8; ++k) {
            (void)here.apply(random_edit(rng, here.project()));
            (void)there.apply(random_edit(rng, there.project()));
        }
        EXPECT_TRUE(validate(merge_edits(imported.scene, here.project().scene, there.project().scene).scene)) << i;
    }
}

// Another program writes its own version over a file that Blush has saved, and the scene before is not known.
TEST(MergeEdits, LightingThatAnotherProgramDropsIsKept) {
    const File exported(2);
    File saved;
    Light softbox;
    softbox.name = "Softbox";
    const Id<Light> light = saved.scene.lights.add(softbox);
    Node rig{.name = "Rig"};
    rig.local.translation = {0, 5, 0};
    const Id<Node> parent = saved.scene.nodes.add(rig);
    Node on_rig{.name = "Softbox"};
    on_rig.parent = parent;
    on_rig.light = light;
    saved.scene.nodes.add(on_rig);
    Node on_vase = *saved.scene.nodes.find(saved.vase); // an object of both files
    Light glow;
    glow.name = "Glow";
    on_vase.light = saved.scene.lights.add(glow);
    saved.scene.nodes.set(saved.vase, on_vase);
    saved.scene.environment.kind = Environment::Kind::constant;
    saved.scene.environment.intensity = 3;
    saved.scene.mix.grouping = LightMix::Grouping::by_light;
    saved.tint({1, 0, 0});
    saved.brighten(9);
    saved.move(saved.stand, {1, 2, 3});
    const Scene base = without_lighting_missing_in(exported.scene, saved.scene);
    const MergedEdits merged = merge_edits(base, saved.scene, exported.scene);
    EXPECT_TRUE(validate(merged.scene));
    EXPECT_EQ(merged.conflicts, std::vector<std::string>{});
    std::map<std::string, Id<Node>> nodes;
    for (const auto& [id, node] : merged.scene.nodes) nodes[node.name] = id;
    const Node* kept = merged.scene.nodes.find(nodes["Softbox"]);
    ASSERT_TRUE(kept && kept->light);
    EXPECT_EQ(merged.scene.lights.find(kept->light)->name, "Softbox");
    EXPECT_EQ(kept->parent, nodes["Rig"]);
    ASSERT_TRUE(merged.scene.nodes.find(nodes["Vase"])->light);
    EXPECT_EQ(merged.scene.lights.find(merged.scene.nodes.find(nodes["Vase"])->light)->name, "Glow");
    EXPECT_EQ(merged.scene.lights.size(), exported.scene.lights.size() + 2);
    EXPECT_EQ(merged.scene.environment.intensity, 3);
    EXPECT_EQ(merged.scene.mix, saved.scene.mix);
    EXPECT_EQ(merged.scene.nodes.size(), exported.scene.nodes.size() + 2);
    EXPECT_EQ(kept->local, on_rig.local);
    EXPECT_EQ(merged.scene.nodes.find(nodes["Rig"])->local, rig.local);
    // What the other program writes is taken from it.
    EXPECT_EQ(merged.scene.materials, exported.scene.materials);
    EXPECT_EQ(merged.scene.lights.find(exported.light)->intensity, 5);
    EXPECT_EQ(*merged.scene.nodes.find(exported.stand), *exported.scene.nodes.find(exported.stand));
}

} // namespace
} // namespace blush::test::TEST_FILE
