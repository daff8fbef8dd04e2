// Recovery files: what comes back, and what does not come through.
#include "io/scene_edits_json.h"
#include "io/sidecar_json.h"
#include "io_gltf_builder.h"
#include "support/random_edits.h"
#include "support/sample_project.h"

#include <gtest/gtest.h>

namespace blush::test {
namespace {

TEST(Sidecar, ComesBack) {
    const Project imported = sample_project().project;
    Rng rng(2);
    for (int sequence = 0; sequence < 20; ++sequence) {
        Project project = imported;
        for (int step = 0; step < 5; ++step) project = *blush::apply(project, random_edit(rng, project));
        const Sidecar sidecar{"/home/a \"quoted\"\nfolder/scene.gltf", hash_text("{}"), edits_json(imported.scene, project.scene),
                              project.render, project.view};
        const auto parsed = parse_sidecar(sidecar_json(sidecar));
        ASSERT_TRUE(parsed) << error_text(parsed);
        EXPECT_EQ(*parsed, sidecar);
    }
}

TEST(Sidecar, HashesTellTextsApart) {
    EXPECT_EQ(hash_text("a"), "af63dc4c8601ec8c"); // published test vectors of FNV-1a, 64 bits
    EXPECT_EQ(hash_text("foobar"), "85944171f73967e8");
}

// Any prefix of a file, any changed byte: an error or a whole sidecar, never a crash.
TEST(Sidecar, DamagedOnesAreErrors) {
    const Scene scene = sample_project().project.scene;
    const std::string whole = sidecar_json({"/scene.gltf", hash_text(""), R"({"format":1})", {}, {}});
    ASSERT_TRUE(parse_sidecar(whole));
    for (size_t length = 0; length < whole.size(); ++length) EXPECT_FALSE(parse_sidecar(whole.substr(0, length))) << length;
    Rng rng(4);
    for (int i = 0; i < 2000; ++i) {
        std::string damaged = whole;
        damaged[std::uniform_int_distribution<size_t>(0, whole.size() - 1)(rng)] = char(std::uniform_int_distribution<int>(0, 255)(rng));
        if (const auto parsed = parse_sidecar(damaged)) (void)apply_edits_json(scene, parsed->edits);
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
} // namespace blush::test
