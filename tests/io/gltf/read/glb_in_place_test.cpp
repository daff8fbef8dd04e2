// GLB files with a large binary chunk, which is read where it lies: the same scene as from the parser's copy, errors as before.
#include "io/gltf/read/source.h"
#include "io/project/scene_hash.h"
#include "tests/io/gltf/builder.h"

#include <gtest/gtest.h>

#include <random>

namespace blush::test::TEST_FILE {
namespace {

// A triangle, with so many unused bytes in its buffer.
GltfBuilder triangle_and(size_t unused) {
    GltfBuilder b;
    b.show({{"attributes", {{"POSITION", b.triangle_positions()}}}});
    b.buffer_view(std::string(unused, '\x55'));
    return b;
}

constexpr size_t large = 100'000;

Result<GltfSource> load(const TempFolder& folder, const std::string& glb) {
    write_bytes(folder / "scene.glb", glb);
    return load_gltf(folder / "scene.glb");
}

TEST(GlbInPlace, OnlyLargeBinariesAre) {
    const TempFolder folder;
    const auto loaded = load(folder, triangle_and(large).glb());
    ASSERT_TRUE(loaded) << error_text(loaded);
    ASSERT_TRUE(loaded->whole_file);
    EXPECT_GE(loaded->binary.data(), loaded->whole_file->data());
    EXPECT_EQ(loaded->binary.size(), 36 + large);
    EXPECT_EQ(loaded->buffer_bytes(0).data(), loaded->binary.data());
    EXPECT_LE(loaded->model.buffers[0].data.size(), 1u) << "not copied";
    EXPECT_EQ(loaded->bytes_in_buffers(), double(36 + large));

    const auto small = load(folder, triangle_and(8).glb());
    ASSERT_TRUE(small) << error_text(small);
    EXPECT_TRUE(small->binary.empty());
    EXPECT_EQ(small->buffer_bytes(0).size(), 44u);
}

TEST(GlbInPlace, TheSceneIsTheSame) {
    const TempFolder folder;
    const GltfBuilder b = triangle_and(large);
    const auto from_glb = import_text(folder, b.glb()), from_gltf = import_text(folder, b.gltf());
    ASSERT_TRUE(from_glb && from_gltf) << error_text(from_glb) << error_text(from_gltf);
    EXPECT_EQ(scene_hash(from_glb->scene), scene_hash(from_gltf->scene));
    EXPECT_EQ(from_glb->report.diagnostics, from_gltf->report.diagnostics);
    EXPECT_NE(from_glb->origin.json->find("byteLength"), std::string::npos) << "the document as it is in the file";
    EXPECT_EQ(from_glb->origin.json->find("base64"), std::string::npos);
}

TEST(GlbInPlace, BuffersBesideItAreReadToo) {
    const TempFolder folder;
    GltfBuilder b = triangle_and(large);
    const float positions[9] = {0, 0, 0, 5, 0, 0, 0, 5, 0};
    const std::string bytes(reinterpret_cast<const char*>(positions), sizeof positions);
    b.further_buffers.push_back({{"byteLength", sizeof positions}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}});
    const int view = b.add("bufferViews", {{"buffer", 1}, {"byteLength", sizeof positions}});
    b.show({{"attributes",
             {{"POSITION", b.add("accessors", {{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}})}}}});
    const auto loaded = load(folder, b.glb());
    ASSERT_TRUE(loaded) << error_text(loaded);
    EXPECT_FALSE(loaded->binary.empty());
    const auto imported = import_gltf(folder / "scene.glb");
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_EQ(imported->scene.meshes.entries().at(0).value.parts.at(0).geometry->positions[1], (Vec3{1, 0, 0}));
    EXPECT_EQ(imported->scene.meshes.entries().at(1).value.parts.at(0).geometry->positions[1], (Vec3{5, 0, 0}));
}

TEST(GlbInPlace, FalseLengthsAreErrors) {
    const TempFolder folder;
    const GltfBuilder b = triangle_and(large);
    std::string longer = b.glb();
    const std::string length = std::to_string(b.buffer.size());
    longer.replace(longer.find("\"byteLength\":" + length), 13 + length.size(), "\"byteLength\":" + std::string(length.size(), '9'));
    EXPECT_FALSE(import_text(folder, longer));
    GltfBuilder beyond = triangle_and(large);
    beyond.json["bufferViews"][0]["byteOffset"] = large + 4;
    EXPECT_NE(error_text(import_text(folder, beyond.glb())).find("reach beyond the buffer's 100036 bytes"), std::string::npos);
    GltfBuilder twice = triangle_and(large); // the second buffer without a URI has no bytes in the file
    twice.further_buffers.push_back({{"byteLength", 36}});
    const auto loaded = load(folder, twice.glb());
    EXPECT_TRUE(!loaded || loaded->binary.empty()) << "left to the parser";
}

TEST(GlbInPlace, RandomBytesOfTheDocumentFlipped) {
    const TempFolder folder;
    const std::string whole = triangle_and(large).glb();
    const size_t document = whole.size() - large;
    std::mt19937 random(1);
    int imported = 0;
    for (int i = 0; i < 500; ++i) {
        std::string broken = whole;
        for (int flips = 1 + int(random() % 3); flips > 0; --flips) broken[random() % document] = char(random());
        imported += bool(import_text(folder, broken));
    }
    EXPECT_GT(imported, 0);
    EXPECT_LT(imported, 500);
}

} // namespace
} // namespace blush::test::TEST_FILE
