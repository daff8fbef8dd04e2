// Recovery files: restored state and rejected input.
#include "io/project/scene_edits_json.h"
#include "io/project/scene_records_json.h"
#include "io/project/sidecar_json.h"
#include "tests/io/gltf/builder.h"
#include "tests/support/random_edits.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

namespace blush::test::TEST_FILE {
namespace {

TEST(Sidecar, RoundTrips) {
    const Project imported = sample_project().project;
    Rng rng(2);
    for (int sequence = 0; sequence < 20; ++sequence) {
        Project project = imported;
        for (int step = 0; step < 5; ++step) project = *blush::apply(project, random_edit(rng, project));
        const Sidecar sidecar = sidecar_of("/home/a \"quoted\"\nfolder/scene.gltf", "{}", imported.scene, project);
        EXPECT_FALSE(sidecar.imported.empty());
        const auto parsed = parse_sidecar(sidecar_json(sidecar));
        ASSERT_TRUE(parsed) << error_text(parsed);
        EXPECT_EQ(*parsed, sidecar);
    }
}

// Light links may name nodes that were removed since; they link nothing, and merging leaves them out.
Table<Light> lights_with_present_links(const Scene& scene) {
    Table<Light> lights;
    for (auto [id, light] : scene.lights) {
        for (ObjectSet* set : {&light.lit_objects, &light.shadow_casters})
            std::erase_if(set->nodes, [&](Id<Node> node) { return !scene.nodes.contains(node); });
        lights.insert(id, light);
    }
    return lights;
}

void expect_same_tables(const Scene& a, const Scene& b, int sequence) {
    EXPECT_TRUE(a.nodes == b.nodes) << sequence;
    EXPECT_TRUE(a.meshes == b.meshes) << sequence;
    EXPECT_TRUE(a.materials == b.materials) << sequence;
    EXPECT_TRUE(a.textures == b.textures) << sequence;
    EXPECT_TRUE(lights_with_present_links(a) == lights_with_present_links(b)) << sequence;
    EXPECT_TRUE(a.cameras == b.cameras) << sequence;
    EXPECT_TRUE(a.environment == b.environment) << sequence;
    EXPECT_TRUE(a.mix == b.mix) << sequence;
    EXPECT_TRUE(a.view == b.view) << sequence;
    EXPECT_TRUE(a.scene_selection == b.scene_selection) << sequence;
}

// A file whose JSON changed without a change of the scene: merging by name equals applying by id.
TEST(Sidecar, EditsApplyToARewrittenFile) {
    const Project imported = sample_project().project;
    Rng rng(9);
    for (int sequence = 0; sequence < 50; ++sequence) {
        Project project = imported;
        for (int step = 0; step < 8; ++step) project = *blush::apply(project, random_edit(rng, project));
        const auto sidecar = parse_sidecar(sidecar_json(sidecar_of("/scene.gltf", "{}", imported.scene, project)));
        ASSERT_TRUE(sidecar) << error_text(sidecar);
        const auto same = recover_edits(*sidecar, imported.scene, "{}"), rewritten = recover_edits(*sidecar, imported.scene, "{ }");
        ASSERT_TRUE(same) << error_text(same);
        ASSERT_TRUE(rewritten) << error_text(rewritten);
        EXPECT_FALSE(same->file_changed);
        EXPECT_TRUE(rewritten->file_changed);
        EXPECT_TRUE(rewritten->conflicts.empty()) << rewritten->conflicts.front();
        EXPECT_EQ(rewritten->project.render, project.render);
        expect_same_tables(same->project.scene, rewritten->project.scene, sequence);
    }
}

TEST(Sidecar, EditsAreMergedByNameIntoAChangedFile) {
    const auto room = [](int shift, float intensity) {
        Scene scene;
        for (int i = 0; i < shift; ++i) {
            Light light;
            light.name = "New " + std::to_string(i);
            scene.lights.add(light);
            Node node;
            node.name = light.name;
            scene.nodes.add(node);
        }
        Light bulb;
        bulb.name = "Bulb";
        bulb.intensity = intensity;
        Node lamp;
        lamp.name = "Lamp";
        lamp.light = scene.lights.add(bulb);
        scene.nodes.add(lamp);
        return scene;
    };
    Project mine{room(0, 5), {}, {}};
    const Scene before = mine.scene;
    mine.scene = room(0, 80);
    const Sidecar sidecar = sidecar_of("/scene.gltf", "before", before, mine);
    const Scene file = room(3, 5);
    const auto recovered = recover_edits(sidecar, file, "after");
    ASSERT_TRUE(recovered) << error_text(recovered);
    EXPECT_TRUE(recovered->conflicts.empty());
    EXPECT_EQ(recovered->project.scene.lights.size(), file.lights.size());
    EXPECT_EQ(recovered->project.scene.lights.find(Id<Light>{4})->intensity, 80) << "the bulb";
    EXPECT_EQ(recovered->project.scene.lights.find(Id<Light>{1})->intensity, 1) << "a light that is new in the file";

    const auto both = recover_edits(sidecar, room(3, 40), "after");
    ASSERT_TRUE(both) << error_text(both);
    EXPECT_EQ(both->project.scene.lights.find(Id<Light>{4})->intensity, 80);
    ASSERT_EQ(both->conflicts.size(), 1u);
    EXPECT_NE(both->conflicts.front().find("Bulb"), std::string::npos);

    Sidecar without = sidecar;
    without.imported.clear();
    EXPECT_FALSE(recover_edits(without, file, "after"));
    EXPECT_TRUE(recover_edits(without, before, "before"));
}

TEST(Sidecar, HashesMatchTestVectors) {
    EXPECT_EQ(hash_text("a"), "af63dc4c8601ec8c"); // published test vectors of FNV-1a, 64 bits
    EXPECT_EQ(hash_text("foobar"), "85944171f73967e8");
}

// Any prefix and any changed byte gives an error or a complete sidecar, never a crash.
TEST(Sidecar, DamagedFilesAreErrors) {
    const Scene scene = sample_project().project.scene;
    const std::string whole = sidecar_json({"/scene.gltf", hash_text(""), R"({"format":1})", records_json(scene), {}, {}});
    ASSERT_TRUE(parse_sidecar(whole));
    for (size_t length = 0; length < whole.size(); ++length) EXPECT_FALSE(parse_sidecar(whole.substr(0, length))) << length;
    Rng rng(4);
    for (int i = 0; i < 2000; ++i) {
        std::string damaged = whole;
        damaged[std::uniform_int_distribution<size_t>(0, whole.size() - 1)(rng)] = char(std::uniform_int_distribution<int>(0, 255)(rng));
        if (const auto parsed = parse_sidecar(damaged)) (void)recover_edits(*parsed, scene, "rewritten");
    }
    EXPECT_FALSE(parse_sidecar(""));
    EXPECT_FALSE(parse_sidecar("[]"));
    EXPECT_FALSE(parse_sidecar(R"({"format":2})"));
    EXPECT_FALSE(parse_sidecar(R"({"format":1,"scene":5,"document_hash":"","edits":{},"render":{},"display":{}})"));
    EXPECT_FALSE(parse_sidecar(R"({"format":1,"scene":"","document_hash":"","edits":[],"render":{},"display":{}})"));
    EXPECT_FALSE(parse_sidecar(R"({"format":1,"scene":"","document_hash":"","edits":{},"render":{"spp":-1},"display":{}})"));
    EXPECT_FALSE(parse_sidecar(std::string(1 << 20, '[')));
}

} // namespace
} // namespace blush::test::TEST_FILE
