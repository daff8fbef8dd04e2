// The Khronos validator reports no new issues for saved files.
#include "io/gltf/write/save.h"
#include "tests/io/gltf/lit.h"
#include "tests/io/gltf/node.h"
#include "tests/io/gltf/saving.h"
#include "tests/support/process.h"
#include "tests/support/random_edits.h"

#include <gtest/gtest.h>

namespace blush::test::TEST_FILE {
namespace {

TEST(GltfValidator, SavingAddsNoMessages) {
    REQUIRE_VALIDATOR();
    const TempFolder folder;
    std::vector<std::string> command{node_program(), BLUSH_VALIDATE_SCRIPT, BLUSH_VALIDATOR};
    Rng rng(3);
    int number = 0;
    // An unknown extension would prevent pruning.
    OrderedJson rich = OrderedJson::parse(text_of(rich_gltf(folder)));
    rich["extensionsUsed"] = {"KHR_lights_punctual"};
    rich["extensions"].erase("ACME_tag");
    rich["extensions"]["KHR_lights_punctual"]["lights"][0].erase("extensions");
    rich["nodes"][0]["extensions"].erase("ACME_tag");
    write_bytes(folder / "rich/known.gltf", rich.dump());
    std::vector<std::filesystem::path> scenes{folder / "rich/known.gltf"};
    for (const char* name : shipped_scenes) scenes.push_back(shipped(name));
    write_bytes(folder / "luminaires.gltf", with_luminaires(folder).gltf());
    write_bytes(folder / "environment.gltf", with_image_light(coloured_faces(4)).gltf());
    for (const char* name : {"luminaires.gltf", "environment.gltf"}) scenes.push_back(folder / name);
    for (const auto& scene : scenes) {
        const ImportedScene original = load(scene);
        for (int sequence = 0; sequence < 12; ++sequence) {
            Project project{original.scene, {}, {}};
            for (int step = 0; step < 3 * sequence; ++step) project = *blush::apply(project, random_edit(rng, project));
            const auto file = folder / fmt::format("{}-{}.{}", scene.stem().string(), number++, sequence % 2 ? "glb" : "gltf");
            const auto saved = save_gltf(original.origin, project, file);
            ASSERT_TRUE(saved) << error_text(saved);
            command.push_back(scene);
            command.push_back(file);
        }
    }
    const Finished validated = run(command);
    EXPECT_EQ(validated.exit_code, 0) << validated.out << validated.err;
}

} // namespace
} // namespace blush::test::TEST_FILE
