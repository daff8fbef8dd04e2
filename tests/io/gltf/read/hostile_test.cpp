// Files that try to break the importer. Each must end in an error or warning that names its cause; the sanitizer build detects
// other faults.
#include "io/gltf/read/uri.h"
#include "io/image/image_io.h"
#include "scene/validate.h"
#include "tests/io/gltf/builder.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

GltfBuilder triangle() {
    GltfBuilder b;
    const int positions = b.triangle_positions();
    b.show({{"attributes", {{"POSITION", positions}}}, {"indices", b.accessor<uint16_t>({0, 1, 2}, "SCALAR")}});
    return b;
}

// One of everything that the importer reads.
GltfBuilder everything() {
    const TempFolder folder;
    const std::vector<float> rgb(4 * 4 * 3, 0.5f);
    EXPECT_TRUE(write_display_image(folder / "image.png", 4, 4, rgb));
    std::ifstream png(folder / "image.png", std::ios::binary);
    GltfBuilder b = triangle();
    b.add("images", {{"bufferView", b.buffer_view(std::string(std::istreambuf_iterator<char>(png), {}))}});
    b.add("samplers", {{"wrapS", 33071}});
    b.add("textures", {{"source", 0}, {"sampler", 0}});
    b.add("materials", {{"pbrMetallicRoughness",
                         {{"baseColorTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {2.0, 2.0}}}}}}}}}},
                        {"normalTexture", {{"index", 0}}},
                        {"extensions", {{"KHR_materials_ior", {{"ior", 1.4}}}}}});
    Json& primitive = b.json["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    primitive["attributes"]["NORMAL"] = b.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    primitive["attributes"]["TEXCOORD_0"] = b.accessor<uint16_t>({0, 0, 65535, 0, 0, 65535}, "VEC2", true);
    b.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_ior", "KHR_texture_transform"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"].push_back({{"type", "spot"}, {"spot", Json::object()}});
    b.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
    b.add("nodes", {{"camera", 0}, {"rotation", {0, 1, 0, 0}}, {"children", {2}}});
    b.add("nodes",
          {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2, 3, 4, 1}}});
    b.json["scenes"].push_back({{"nodes", {0, 1}}, {"extras", {{"blush", {{"environment", {{"kind", "constant"}}}}}}}});
    return b;
}

struct Break {
    const char* name;
    void (*apply)(Json&);
    const char* message; // part of the error
};
void PrintTo(const Break& b, std::ostream* out) { *out << b.name; }

class HostileField : public testing::TestWithParam<Break> {};

TEST_P(HostileField, EndsInAnErrorThatNamesTheCause) {
    GltfBuilder b = triangle();
    GetParam().apply(b.json);
    const auto imported = import_built(b);
    ASSERT_FALSE(imported);
    EXPECT_NE(imported.error().what.find(GetParam().message), std::string::npos) << imported.error().text();
}

constexpr uint64_t huge = std::numeric_limits<uint64_t>::max();
const Break breaks[] = {
    {"AccessorIndex", [](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 99; }, "accessor 99 does not exist"},
    {"NegativeAccessor", [](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = -1; }, "accessor -1 does not exist"},
    {"BufferViewIndex", [](Json& j) { j["accessors"][0]["bufferView"] = 99; }, "buffer view 99 does not exist"},
    {"BufferIndex", [](Json& j) { j["bufferViews"][0]["buffer"] = 99; }, "buffer 99 does not exist"},
    {"AccessorBeyondItsView", [](Json& j) { j["accessors"][0]["count"] = 4; }, "reach beyond the buffer view"},
    {"AccessorOffset", [](Json& j) { j["accessors"][0]["byteOffset"] = 8; }, "reach beyond the buffer view"},
    {"OffsetOverflow", [](Json& j) { j["accessors"][0]["byteOffset"] = huge - 3; }, "reach beyond the buffer view"},
    {"CountOverflow", [](Json& j) { j["accessors"][0]["count"] = huge / 12 + 2; }, "reach beyond the buffer view"},
    {"CountWithoutBytes",
     [](Json& j) {
         j["accessors"][0].erase("bufferView");
         j["accessors"][0]["count"] = huge;
     },
     "without a buffer view"},
    {"ViewBeyondItsBuffer", [](Json& j) { j["bufferViews"][0]["byteLength"] = 1000; }, "reach beyond the buffer"},
    {"ViewOffsetOverflow", [](Json& j) { j["bufferViews"][0]["byteOffset"] = huge; }, "reach beyond the buffer"},
    {"StrideBelowElement", [](Json& j) { j["bufferViews"][0]["byteStride"] = 4; }, "byteStride 4 is less"},
    {"PositionsOfTwoComponents", [](Json& j) { j["accessors"][0]["type"] = "VEC2"; }, "wrong number of components"},
    {"MatrixAccessor", [](Json& j) { j["accessors"][0]["type"] = "MAT4"; }, "wrong number of components"},
    {"DoubleComponents", [](Json& j) { j["accessors"][0]["componentType"] = 5130; }, "component type 5130"},
    {"SignedIndices", [](Json& j) { j["accessors"][1]["componentType"] = 5122; }, "does not hold unsigned scalars"},
    {"IndexBeyondVertices", [](Json& j) { j["accessors"][0]["count"] = 2; }, "not below the number of vertices"},
    {"UnlikeLengths",
     [](Json& j) {
         j["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2;
         j["accessors"].push_back(j["accessors"][0]);
         j["accessors"][2]["count"] = 2;
     },
     "2 elements for 3 positions"},
    {"SparseIndex",
     [](Json& j) {
         j["accessors"][0]["sparse"] = {
             {"count", 1}, {"indices", {{"bufferView", 1}, {"byteOffset", 4}, {"componentType", 5121}}}, {"values", {{"bufferView", 0}}}};
         j["accessors"][0]["count"] = 2;
     },
     "is not below the count"},
    {"SparseCount",
     [](Json& j) {
         j["accessors"][0]["sparse"] = {
             {"count", -1}, {"indices", {{"bufferView", 1}, {"componentType", 5121}}}, {"values", {{"bufferView", 0}}}};
     },
     "negative count"},
    {"MeshIndex", [](Json& j) { j["nodes"][0]["mesh"] = 99; }, "mesh 99 does not exist"},
    {"CameraIndex", [](Json& j) { j["nodes"][0]["camera"] = 99; }, "camera 99 does not exist"},
    {"SceneIndex", [](Json& j) { j["scene"] = 3; }, "scene 3 does not exist"},
    {"RootIndex",
     [](Json& j) {
         j["scenes"] = Json::array({Json{{"nodes", {9}}}});
     },
     "node 9 does not exist"},
    {"RootTwice",
     [](Json& j) {
         j["scenes"] = Json::array({Json{{"nodes", {0, 0}}}});
     },
     "listed twice"},
    {"MissingBuffer",
     [](Json& j) {
         j["buffers"] = Json::array({Json{{"byteLength", 44}, {"uri", "none.bin"}}});
     },
     "none.bin"},
    {"BufferWithoutUri",
     [](Json& j) {
         j["buffers"] = Json::array({Json{{"byteLength", 44}}});
     },
     "'uri' is missing"},
    {"ParentFolder",
     [](Json& j) {
         j["buffers"] = Json::array({Json{{"byteLength", 44}, {"uri", "../secret.bin"}}});
     },
     "leaves the scene's folder"},
    {"EscapedParent",
     [](Json& j) {
         j["buffers"] = Json::array({Json{{"byteLength", 44}, {"uri", "a/%2e%2e/%2E%2E/secret.bin"}}});
     },
     "leaves the scene's folder"},
    {"AbsoluteUri",
     [](Json& j) {
         j["buffers"] = Json::array({Json{{"byteLength", 44}, {"uri", "/etc/passwd"}}});
     },
     "is an absolute path"},
    {"Http",
     [](Json& j) {
         j["buffers"] = Json::array({Json{{"byteLength", 44}, {"uri", "http://example.org/a.bin"}}});
     },
     "has a scheme"},
    {"FileScheme",
     [](Json& j) {
         j["images"] = Json::array({Json{{"uri", "file:///etc/passwd"}}});
     },
     "has a scheme"},
    {"WrongBase64",
     [](Json& j) {
         j["buffers"] = Json::array({Json{{"byteLength", 44}, {"uri", "data:application/octet-stream;base64,!!"}}});
     },
     "not a valid glTF file"},
    {"Version1", [](Json& j) { j["asset"]["version"] = "1.0"; }, "glTF version 1.0"},
    {"NoAsset", [](Json& j) { j.erase("asset"); }, "no asset version"},
    {"RequiredExtension", [](Json& j) { j["extensionsRequired"] = {"KHR_animation_pointer"}; }, "needs KHR_animation_pointer"},
    {"NodesOfTheWrongKind",
     [](Json& j) {
         j["nodes"] = {1, 2, 3};
     },
     "not a valid glTF file"},
};
INSTANTIATE_TEST_SUITE_P(, HostileField, testing::ValuesIn(breaks), [](const auto& test) { return std::string(test.param.name); });

TEST(HostileGltf, TheIntactFileIsRead) {
    const auto imported = import_built(everything());
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_EQ(imported->scene.textures.size(), 1u);
    EXPECT_EQ(imported->scene.nodes.size(), 3u);
    EXPECT_EQ(imported->report.diagnostics.size(), 5u)
        << "tangents, back faces, clipping planes, and a normal map that is also a colour and has no normals";
    const auto valid = validate(imported->scene);
    EXPECT_TRUE(valid) << error_text(valid);
}

TEST(HostileGltf, EveryPositionNonFiniteIsAnError) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    GltfBuilder b;
    b.show({{"attributes", {{"POSITION", b.accessor<float>(std::vector<float>(9, nan), "VEC3")}}}});
    EXPECT_NE(error_text(import_built(b)).find("every triangle has a NaN"), std::string::npos);
}

// A hundred primitives with arrays of zeros that need no bytes: 20 GB from a file of a few kilobytes.
TEST(HostileGltf, DecodedSizeIsLimited) {
    GltfBuilder b = triangle();
    for (int i = 0; i < 100; ++i) {
        const int zeros = b.add("accessors", {{"componentType", 5126}, {"count", 1 << 24}, {"type", "VEC3"}});
        b.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", zeros}}}});
    }
    EXPECT_NE(error_text(import_built(b)).find("need 20133 MB when decoded"), std::string::npos) << error_text(import_built(b));
}

TEST(HostileGltf, DeeplyNestedJsonIsRefusedBeforeAnyRecursion) {
    const TempFolder folder;
    const std::string nested = std::string(1000000, '[') + std::string(1000000, ']');
    EXPECT_NE(error_text(import_text(folder, R"({"asset":{"version":"2.0"},"extras":)" + nested + "}")).find("nested deeper"),
              std::string::npos);
    // Brackets in a string are text, also after an escaped quote.
    const std::string text = R"({"asset":{"version":"2.0","generator":"\")" + std::string(1000, '[') + R"("}})";
    EXPECT_TRUE(import_text(folder, text));
}

TEST(HostileGltf, SymbolicLinksOutOfTheFolderAreNotFollowed) {
    const TempFolder outside, folder;
    write_bytes(outside / "secret.bin", std::string(44, '\0'));
    std::filesystem::create_symlink(outside.path(), folder / "link");
    GltfBuilder b = triangle();
    b.json["buffers"] = Json::array({Json{{"byteLength", 44}, {"uri", "link/secret.bin"}}});
    EXPECT_NE(error_text(import_text(folder, b.gltf())).find("symbolic link"), std::string::npos);
}

TEST(HostileGltf, FilesThatAreNotScenes) {
    const TempFolder folder;
    EXPECT_FALSE(import_gltf(folder / "none.gltf"));
    EXPECT_FALSE(import_gltf(folder.path()));
    EXPECT_FALSE(import_gltf("/dev/zero"));
    for (const std::string& text :
         {std::string(), std::string("[]"), std::string("null"), std::string("{\"asset\":"), std::string(1000, '\xff')})
        EXPECT_FALSE(import_text(folder, text)) << text;
}

TEST(HostileGltf, TruncatedAnywhere) {
    const TempFolder folder;
    const std::string whole = everything().glb();
    ASSERT_TRUE(import_text(folder, whole));
    for (size_t length = 4; length < whole.size(); ++length) ASSERT_FALSE(import_text(folder, whole.substr(0, length))) << length;
}

TEST(HostileGltf, RandomBytesFlipped) {
    const TempFolder folder;
    const std::string whole = everything().glb();
    std::mt19937 random(1);
    int imported_count = 0;
    for (int i = 0; i < 2000; ++i) {
        std::string broken = whole;
        for (int flips = 1 + int(random() % 4); flips > 0; --flips) broken[random() % broken.size()] = char(random());
        const auto imported = import_text(folder, broken);
        if (!imported) continue;
        ++imported_count;
        const auto valid = validate(imported->scene);
        ASSERT_TRUE(valid) << "iteration " << i << ": " << error_text(valid);
    }
    // Both outcomes occur: rejected files, and files whose damage has no effect.
    EXPECT_GT(imported_count, 0);
    EXPECT_LT(imported_count, 2000);
}

TEST(HostileGltf, GlbWithFalseLengths) {
    const TempFolder folder;
    const std::string whole = triangle().glb();
    for (const size_t field : {size_t(8), size_t(12)}) // the file's and the first chunk's length
        for (const uint32_t value : {0u, 1u, 11u, 0x7fffffffu, 0xffffffffu, uint32_t(whole.size()) + 1}) {
            std::string broken = whole;
            std::memcpy(broken.data() + field, &value, sizeof value);
            EXPECT_FALSE(import_text(folder, broken)) << field << " " << value;
        }
    // A zero-length file with all values of the chunk length.
    std::string both = whole;
    std::fill_n(both.begin() + 8, 4, '\0');
    std::fill_n(both.begin() + 12, 4, '\xff');
    EXPECT_NE(error_text(import_text(folder, both)).find("fewer than a GLB header"), std::string::npos);
}

TEST(ResolveUri, KeepsToTheFolder) {
    const TempFolder folder;
    const auto plain = resolve_uri(folder.path(), "maps/a.png");
    ASSERT_TRUE(plain) << error_text(plain);
    EXPECT_EQ(*plain, std::filesystem::canonical(folder.path()) / "maps/a.png");
    EXPECT_TRUE(resolve_uri(folder.path(), "./a b.png"));
    for (const std::string& uri : {std::string(), std::string("/a"), std::string("a/../../b"), std::string("c:/a"), std::string("data:x"),
                                   std::string("..\\a"), std::string("a\0b", 3)})
        EXPECT_FALSE(resolve_uri(folder.path(), uri)) << uri;
    EXPECT_EQ(percent_decoded("a%20b%2Fc%zz%4"), "a b/c%zz%4");
}

} // namespace
} // namespace blush::test::TEST_FILE
