// Parallel decompression: the result does not depend on the threads; size limits.
#include "io/project/scene_hash.h"
#include "tests/io/gltf/packed.h"

#include <gtest/gtest.h>

#include <atomic>
#include <fmt/format.h>

namespace blush::test::TEST_FILE {
namespace {

// Meshes of many sizes, compressed alternately by both libraries, one with an invalid attribute id.
GltfBuilder packed_by_both(uint32_t meshes = 16) {
    GltfBuilder b;
    begin_meshopt(b);
    b.json["extensionsUsed"] = b.json["extensionsRequired"] = {draco_extension, meshopt_extension};
    for (uint32_t i = 0; i < meshes; ++i) {
        const Sheet sheet(3 + 5 * i % 31);
        if (i % 2)
            show_packed_by_meshopt(b, sheet, packed_indices(sheet, false, 4));
        else
            show_packed_by_draco(b, sheet, draco_bytes(sheet, 3, 12));
    }
    Json& primitive = b.json["meshes"][6]["primitives"][0];
    primitive["attributes"]["_OWN"] = primitive["attributes"]["POSITION"];
    primitive["extensions"][draco_extension]["attributes"]["_OWN"] = "the first";
    return b;
}

Result<ImportedScene> import_with(const GltfBuilder& b, unsigned threads) {
    ImportOptions options;
    options.threads = threads;
    return import_built(b, options);
}

// Without its file.
std::string error_with(const GltfBuilder& b, unsigned threads) {
    const auto imported = import_with(b, threads);
    return imported ? "" : imported.error().what + ", " + imported.error().where;
}

TEST(GltfDecompression, ResultDoesNotDependOnThreads) {
    const GltfBuilder b = packed_by_both();
    const auto serial = import_with(b, 1);
    ASSERT_TRUE(serial) << error_text(serial);
    EXPECT_TRUE(reports(serial->report, "is not an integer"));
    EXPECT_EQ(serial->scene.meshes.size(), 16u);
    for (const unsigned threads : {0u, 2u, 3u, 8u}) {
        const auto parallel = import_with(b, threads);
        ASSERT_TRUE(parallel) << error_text(parallel);
        EXPECT_EQ(scene_hash(parallel->scene), scene_hash(serial->scene));
        EXPECT_EQ(parallel->report.diagnostics, serial->report.diagnostics);
        EXPECT_EQ(parallel->origin.indices.primitives, serial->origin.indices.primitives);
    }
}

TEST(GltfDecompression, TheFirstErrorInTheFileIsReported) {
    GltfBuilder draco = packed_by_both(), meshopt = draco;
    for (const size_t mesh : {4, 8, 14}) {
        const size_t view = draco.json["meshes"][mesh]["primitives"][0]["extensions"][draco_extension]["bufferView"];
        const size_t length = draco.json["bufferViews"][view]["byteLength"];
        draco.json["bufferViews"][view]["byteLength"] = length / 2;
    }
    std::vector<size_t> packed;
    for (size_t i = 0; i < meshopt.json["bufferViews"].size(); ++i)
        if (meshopt.json["bufferViews"][i].contains("extensions")) packed.push_back(i);
    for (const size_t i : {packed[9], packed[5], packed[20]})
        meshopt.json["bufferViews"][i]["extensions"][meshopt_extension]["byteLength"] = 40;
    for (const auto& [built, where] :
         {std::pair(draco, std::string("meshes[4].primitives[0].")), std::pair(meshopt, fmt::format("bufferViews[{}]", packed[5]))}) {
        const std::string serial = error_with(built, 1);
        EXPECT_NE(serial.find(where), serial.npos) << serial;
        for (int round = 0; round < 20; ++round) EXPECT_EQ(error_with(built, 8), serial);
    }
}

TEST(GltfDecompression, CanBeCancelledAnywhere) {
    const GltfBuilder b = packed_by_both();
    for (const unsigned threads : {1u, 8u})
        for (const double when : {0.02, 0.06, 0.15, 0.25}) {
            std::atomic<bool> cancel = false;
            double reached = 0;
            ImportOptions options;
            options.threads = threads;
            options.cancel = &cancel;
            options.on_progress = [&](double fraction, const std::string&) {
                if (fraction >= when) cancel = true;
                EXPECT_GE(fraction, reached);
                reached = fraction;
            };
            const auto imported = import_built(b, options);
            ASSERT_FALSE(imported);
            EXPECT_EQ(imported.error().what, "cancelled");
            if (threads == 1) { EXPECT_LT(reached, when + 0.05) << "no other threads"; }
        }
}

// Compressed bytes that are referenced many times would exceed the memory: detected before decompression.
TEST(GltfDecompression, DecompressedSizeIsLimited) {
    const Sheet sheet(200);
    GltfBuilder draco = packed_by_draco(sheet, draco_bytes(sheet, 10, 8));
    EXPECT_EQ(error_with(draco, 2), "");
    const Json primitive = draco.json["meshes"][0]["primitives"][0];
    for (int i = 0; i < 300; ++i) draco.json["meshes"][0]["primitives"].push_back(primitive);
    EXPECT_NE(error_with(draco, 2).find("would decompress to"), std::string::npos) << error_with(draco, 2);

    const std::vector<float> zeros(3 << 20);
    GltfBuilder meshopt = packed_by_meshopt(sheet, packed_indices(sheet, false, 4));
    add_packed_view(meshopt, packed_vertices(zeros.data(), zeros.size() / 3, 12));
    EXPECT_EQ(error_with(meshopt, 2), "");
    const Json view = meshopt.json["bufferViews"].back();
    for (int i = 0; i < 100; ++i) meshopt.json["bufferViews"].push_back(view);
    EXPECT_NE(error_with(meshopt, 2).find("would decompress to"), std::string::npos) << error_with(meshopt, 2);
}

} // namespace
} // namespace blush::test::TEST_FILE
