// Parallel import: the result does not depend on the threads; preview scene before the textures are decoded.
#include "io/gltf/read/images/image_decoding.h"
#include "io/image/image_io.h"
#include "io/image/jpeg_encoding.h"
#include "io/project/scene_hash.h"
#include "scene/document/preview_scene.h"
#include "scene/validate.h"
#include "tests/io/gltf/builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

std::string noisy_png(int side, unsigned seed) {
    std::mt19937 random(seed);
    Image image{.width = side, .height = side, .channels = 3, .bytes = {}, .floats = {}};
    for (int i = 0; i < side * side * 3; ++i) image.bytes.push_back(uint8_t(random()));
    const auto bytes = encode_png(image);
    EXPECT_TRUE(bytes);
    return {bytes->begin(), bytes->end()};
}

void add_texture(GltfBuilder& b, const std::string& png) {
    const int image = b.add("images", {{"bufferView", b.buffer_view(png)}, {"mimeType", "image/png"}});
    b.add("textures", {{"source", image}});
}

// A grid with normals and texture coordinates, wavy enough for tangents to differ.
Json grid(GltfBuilder& b, int side, float phase, int material) {
    std::vector<float> positions, normals, uv;
    std::vector<uint32_t> indices;
    for (int y = 0; y <= side; ++y)
        for (int x = 0; x <= side; ++x) {
            const float u = float(x) / float(side), v = float(y) / float(side), slope = std::cos(9 * u + phase);
            positions.insert(positions.end(), {u, v, std::sin(9 * u + phase) / 9});
            normals.insert(normals.end(), {-slope, 0, 1});
            uv.insert(uv.end(), {u, v * v});
        }
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const auto i = uint32_t(y * (side + 1) + x), above = i + uint32_t(side) + 1;
            indices.insert(indices.end(), {i, i + 1, above, above, i + 1, above + 1});
        }
    const int p = b.accessor<float>(positions, "VEC3"), n = b.accessor<float>(normals, "VEC3"), t = b.accessor<float>(uv, "VEC2");
    return {{"attributes", {{"POSITION", p}, {"NORMAL", n}, {"TEXCOORD_0", t}, {"_OWN", p}}},
            {"indices", b.accessor<uint32_t>(indices, "SCALAR")},
            {"material", material}};
}

// Meshes with several primitives, most of which cause diagnostics, a light, a camera, and textures.
GltfBuilder large_file(int meshes = 12) {
    GltfBuilder b;
    for (unsigned i = 0; i < 6; ++i) add_texture(b, noisy_png(64, i));
    for (int i = 0; i < 6; ++i)
        b.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}, {"normalTexture", {{"index", (i + 1) % 6}}}});
    for (int i = 0; i < meshes; ++i) {
        Json wavy = grid(b, 5 + i % 7, float(i), i % 6);
        Json broken{{"attributes", {{"POSITION", b.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, NAN, 0, 0, 1, 1, 0, 2, 2, 0}, "VEC3")}}}};
        Json points{{"attributes", {{"POSITION", b.triangle_positions()}}}, {"mode", 0}};
        Json strange{{"attributes", {{"POSITION", b.triangle_positions()}}}, {"mode", 9}};
        const int mesh = b.add("meshes", {{"primitives", {wavy, broken, points, strange}}});
        b.add("nodes", {{"mesh", mesh}, {"translation", {i, 0, 0}}});
    }
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 100}}};
    b.json["extensionsUsed"] = {"KHR_lights_punctual"};
    b.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"translation", {0, 0, 3}}});
    b.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
    b.add("nodes", {{"camera", 0}, {"translation", {3, 0, 9}}});
    return b;
}

bool same_numbers(const Vec3& a, const Vec3& b) { return std::memcmp(&a, &b, sizeof a) == 0; }
bool same_numbers(const Vec4& a, const Vec4& b) { return std::memcmp(&a, &b, sizeof a) == 0; }
bool same_numbers(const Vec2& a, const Vec2& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// Bit for bit.
template <class Values> bool same_numbers(const Values& a, const Values& b) {
    return std::ranges::equal(a, b, [](const auto& x, const auto& y) { return same_numbers(x, y); });
}
bool same_vertices(const Geometry& a, const Geometry& b) {
    return same_numbers(a.positions, b.positions) && same_numbers(a.normals, b.normals) && same_numbers(a.tangents, b.tangents) &&
           same_numbers(a.colors, b.colors) && a.indices == b.indices && a.flat == b.flat && same_numbers(a.uv, b.uv);
}

// Payloads of two imports have different serials: compared by content.
void expect_same(const ImportedScene& a, const ImportedScene& b) {
    EXPECT_EQ(a.report.diagnostics, b.report.diagnostics);
    EXPECT_EQ(a.report.extensions_used, b.report.extensions_used);
    EXPECT_EQ(a.scene.materials, b.scene.materials);
    EXPECT_EQ(a.scene.nodes, b.scene.nodes);
    EXPECT_EQ(a.scene.lights, b.scene.lights);
    EXPECT_EQ(a.scene.cameras, b.scene.cameras);
    EXPECT_EQ(a.scene.view, b.scene.view);
    EXPECT_EQ(a.origin.indices.meshes, b.origin.indices.meshes);
    EXPECT_EQ(a.origin.indices.textures, b.origin.indices.textures);
    EXPECT_EQ(a.origin.indices.primitives, b.origin.indices.primitives);
    EXPECT_EQ(scene_hash(a.scene), scene_hash(b.scene));
    ASSERT_EQ(a.scene.meshes.size(), b.scene.meshes.size());
    for (const auto& [id, mesh] : a.scene.meshes) {
        const Mesh* other = b.scene.meshes.find(id);
        ASSERT_TRUE(other);
        EXPECT_EQ(mesh.name, other->name);
        ASSERT_EQ(mesh.parts.size(), other->parts.size());
        for (size_t p = 0; p < mesh.parts.size(); ++p) {
            EXPECT_EQ(mesh.parts[p].material, other->parts[p].material);
            EXPECT_TRUE(same_vertices(*mesh.parts[p].geometry, *other->parts[p].geometry)) << mesh.name << ", " << p;
        }
    }
    ASSERT_EQ(a.scene.textures.size(), b.scene.textures.size());
    for (const auto& [id, texture] : a.scene.textures) {
        const Texture* other = b.scene.textures.find(id);
        ASSERT_TRUE(other);
        EXPECT_EQ(texture.image->bytes, other->image->bytes);
    }
}

Result<ImportedScene> import_with(const GltfBuilder& b, unsigned threads) {
    ImportOptions options;
    options.threads = threads;
    return import_built(b, options);
}

TEST(GltfParallel, ResultDoesNotDependOnThreads) {
    const GltfBuilder b = large_file();
    const auto serial = import_with(b, 1);
    ASSERT_TRUE(serial) << error_text(serial);
    EXPECT_TRUE(reports(serial->report, "NaN")) << "the file causes diagnostics";
    EXPECT_GE(serial->report.diagnostics.size(), 48u);
    for (const unsigned threads : {0u, 2u, 3u, 8u}) {
        const auto parallel = import_with(b, threads);
        ASSERT_TRUE(parallel) << error_text(parallel);
        expect_same(*serial, *parallel);
    }
}

TEST(GltfParallel, DiagnosticsAreInFileOrder) {
    const auto imported = import_with(large_file(), 8);
    ASSERT_TRUE(imported) << error_text(imported);
    int mesh = 0, last = 0;
    for (const Diagnostic& d : imported->report.diagnostics)
        if (std::sscanf(d.where.c_str(), "meshes[%d]", &mesh) == 1) {
            EXPECT_GE(mesh, last);
            last = mesh;
        }
    EXPECT_EQ(last, 11);
}

TEST(GltfParallel, TooManyDiagnosticsEndInTheSameLine) {
    const GltfBuilder b = large_file(200);
    const auto serial = import_with(b, 1), parallel = import_with(b, 8);
    ASSERT_TRUE(serial && parallel);
    EXPECT_EQ(serial->report.diagnostics, parallel->report.diagnostics);
    EXPECT_EQ(serial->report.diagnostics.back().what, "more findings than can be listed");
}

TEST(GltfParallel, TheFirstErrorInTheFileIsReported) {
    GltfBuilder b = large_file();
    b.json["meshes"][4]["primitives"][1]["material"] = 97;
    b.json["meshes"][3]["primitives"][2]["material"] = 99;
    b.json["meshes"][9]["primitives"][0]["material"] = 98;
    const std::string serial = error_text(import_with(b, 1));
    EXPECT_NE(serial.find("meshes[3].primitives[2]"), serial.npos) << serial;
    for (int round = 0; round < 20; ++round) {
        const std::string parallel = error_text(import_with(b, 8));
        EXPECT_EQ(parallel.substr(parallel.find(": ")), serial.substr(serial.find(": "))); // folders differ
    }
}

// The header is valid, so that meshes get tangents for a normal map that then cannot be decoded.
TEST(GltfParallel, BrokenTexturesDoNotAffectMeshes) {
    GltfBuilder b = large_file(), without = large_file();
    const size_t offset = b.json["bufferViews"][2]["byteOffset"], length = b.json["bufferViews"][2]["byteLength"];
    std::fill_n(b.buffer.begin() + std::ptrdiff_t(offset + 60), length - 60, '\0');
    without.json["images"][2] = {{"uri", "missing.png"}};
    const auto serial = import_with(b, 1);
    for (const unsigned threads : {1u, 8u}) {
        const auto broken = import_with(b, threads), missing = import_with(without, threads);
        ASSERT_TRUE(broken && missing);
        expect_same(*serial, *broken);
        EXPECT_EQ(broken->scene.textures.size(), 5u);
        EXPECT_EQ(broken->scene.materials, missing->scene.materials);
        for (size_t m = 0; m < 12; ++m)
            EXPECT_TRUE(same_vertices(*broken->scene.meshes.entries()[m].value.parts[0].geometry,
                                      *missing->scene.meshes.entries()[m].value.parts[0].geometry));
    }
}

TEST(GltfParallel, CanBeCancelledAnywhere) {
    const GltfBuilder b = large_file();
    for (const unsigned threads : {1u, 8u})
        for (const double when : {0.1, 0.35, 0.5, 0.62, 0.9}) {
            std::atomic<bool> cancel = false;
            bool reached_the_end = false;
            ImportOptions options;
            options.threads = threads;
            options.cancel = &cancel;
            options.on_progress = [&](double fraction, const std::string&) {
                if (fraction >= when) cancel = true;
                reached_the_end |= fraction == 1;
            };
            const auto imported = import_built(b, options);
            // Other threads may have finished all work by then.
            if (imported) {
                EXPECT_TRUE(reached_the_end);
                EXPECT_GT(when, 0.35);
            } else {
                EXPECT_EQ(imported.error().what, "cancelled");
            }
        }
}

TEST(GltfParallel, PreviewSceneComesBeforeTheTextures) {
    const GltfBuilder b = large_file();
    std::vector<ImportedScene> early;
    ImportOptions options;
    options.threads = 1; // no decoding before the rest is converted
    options.on_preview_scene = [&](const ImportedScene& scene) { early.push_back(scene); };
    const auto whole = import_built(b, options);
    ASSERT_TRUE(whole) << error_text(whole);
    ASSERT_FALSE(early.empty());
    const Scene& scene = early[0].scene;
    EXPECT_TRUE(validate(scene));
    EXPECT_TRUE(scene.textures.empty());
    EXPECT_TRUE(scene.meshes.shares_storage(whole->scene.meshes)); // meshes are converted only once
    EXPECT_EQ(scene.nodes, whole->scene.nodes);
    EXPECT_EQ(scene.lights, whole->scene.lights);
    EXPECT_EQ(scene.cameras, whole->scene.cameras);
    EXPECT_EQ(scene.view, whole->scene.view);
    EXPECT_EQ(early[0].has_view, whole->has_view);
    Scene without_images = whole->scene;
    for (const auto& [id, texture] : whole->scene.textures) {
        Texture missing = texture;
        missing.image = nullptr;
        without_images.textures.set(id, missing);
    }
    EXPECT_EQ(scene, preview_scene(without_images));
}

TEST(GltfParallel, JpegsAreFirstShownAtAnEighth) {
    constexpr int side = 1024;
    std::vector<uint8_t> rgb;
    for (int i = 0; i < side * side; ++i) rgb.insert(rgb.end(), {uint8_t(i % side / 4), uint8_t(i / side / 4), 200});
    const auto jpeg = encode_jpeg("ramp", side, side, rgb);
    ASSERT_TRUE(jpeg);
    const auto full = read_image(*jpeg, "ramp");
    ASSERT_TRUE(full);
    GltfBuilder b = large_file();
    const std::string bytes(jpeg->begin(), jpeg->end());
    const int image = b.add("images", {{"bufferView", b.buffer_view(bytes)}, {"mimeType", "image/jpeg"}});
    b.json["textures"][0]["source"] = image;
    for (const unsigned threads : {1u, 2u}) {
        std::vector<ImportedScene> early;
        ImportOptions options;
        options.threads = threads;
        options.on_preview_scene = [&](const ImportedScene& scene) { early.push_back(scene); };
        const auto whole = import_built(b, options);
        ASSERT_TRUE(whole) << error_text(whole);
        EXPECT_EQ(whole->scene.textures.entries()[0].value.image->bytes, (*full)->bytes);
        if (threads > 1) continue; // the other thread may have decoded everything by then
        ASSERT_GE(early.size(), 2u);
        const Scene& shown = early[1].scene;
        EXPECT_TRUE(validate(shown));
        ASSERT_EQ(shown.textures.size(), 1u); // the others are not decoded yet
        const Image& small = *shown.textures.begin()->value.image;
        ASSERT_EQ(small.width, side / 8);
        ASSERT_EQ(small.height, side / 8);
        ASSERT_EQ(small.channels, 3);
        for (int y = 0; y < small.height; ++y)
            for (int x = 0; x < small.width; ++x) {
                const size_t pixel = (size_t(y) * size_t(small.width) + size_t(x)) * 3;
                ASSERT_NEAR(small.bytes[pixel], 2 * x + 0.5, 3);
                ASSERT_NEAR(small.bytes[pixel + 1], 2 * y + 0.5, 3);
            }
    }
}

TEST(GltfParallel, ImagesThatAreDecodedTogetherHaveALimitedSize) {
    EXPECT_EQ(concurrent_decode_bytes(uint64_t(4) << 30), int64_t(512) << 20);
    EXPECT_EQ(concurrent_decode_bytes(0), int64_t(64) << 20);
    EXPECT_EQ(concurrent_decode_bytes(uint64_t(1) << 50), int64_t(1) << 30);
}

// The textures 0 and 1 are normal maps, 2 and 3 colours; 0 and 2 are large.
GltfBuilder colors_and_normal_maps() {
    GltfBuilder b;
    b.show({{"attributes", {{"POSITION", b.triangle_positions()}}}});
    for (unsigned i = 0; i < 4; ++i) add_texture(b, noisy_png(i % 2 == 0 ? 128 : 32, i));
    for (const int color : {2, 3})
        b.add("materials",
              {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", color}}}}}, {"normalTexture", {{"index", color - 2}}}});
    return b;
}

// What a first image needs most. The file has its images in the opposite order.
TEST(GltfParallel, ColourAndSmallImagesAreDecodedFirst) {
    const GltfBuilder b = colors_and_normal_maps();
    const TempFolder folder;
    write_bytes(folder / "scene.glb", b.glb());
    const auto source = load_gltf(folder / "scene.glb");
    ASSERT_TRUE(source) << error_text(source);
    std::vector<int> order;
    std::function<void()> look = [] {};
    ImportOptions options;
    options.threads = 1;
    options.on_preview_scene = [](const ImportedScene&) {};
    options.on_progress = [&](double, const std::string&) { look(); };
    ImportReport report;
    const GltfContext context{*source, options, report};
    auto decoding = ImageDecoding::begin(context, std::vector{0, 1, 2, 3});
    ASSERT_TRUE(decoding) << error_text(decoding);
    look = [&] {
        for (int i = 0; i < 4; ++i)
            if (decoding->available(i) && std::ranges::find(order, i) == order.end()) order.push_back(i);
    };
    ASSERT_TRUE(decoding->finish());
    EXPECT_EQ(order, (std::vector{3, 2, 1, 0}));
}

TEST(GltfParallel, AllColoursAreShownAtOnce) {
    std::vector<ImportedScene> early;
    ImportOptions options;
    options.threads = 1;
    options.on_preview_scene = [&](const ImportedScene& scene) { early.push_back(scene); };
    const auto whole = import_built(colors_and_normal_maps(), options);
    ASSERT_TRUE(whole) << error_text(whole);
    const auto with_colors = std::ranges::find_if(early, [](const ImportedScene& shown) { return shown.scene.textures.size() == 2; });
    ASSERT_NE(with_colors, early.end()) << "without waiting for the pause between previews";
    for (const auto& [id, material] : with_colors->scene.materials) {
        EXPECT_TRUE(material.base_color_texture.texture);
        EXPECT_FALSE(material.normal_texture.texture);
    }
}

TEST(GltfParallel, NoPreviewWithoutTextures) {
    GltfBuilder b;
    b.show({{"attributes", {{"POSITION", b.triangle_positions()}}}});
    ImportOptions options;
    options.threads = 1;
    options.on_preview_scene = [&](const ImportedScene&) { ADD_FAILURE() << "there is nothing to wait for"; };
    EXPECT_TRUE(import_built(b, options));
}

TEST(GltfParallel, CancelledWhileTexturesAreMissing) {
    std::atomic<bool> cancel = false;
    ImportOptions options;
    options.threads = 1;
    options.cancel = &cancel;
    options.on_preview_scene = [&](const ImportedScene&) { cancel = true; };
    const auto imported = import_built(large_file(), options);
    ASSERT_FALSE(imported);
    EXPECT_EQ(imported.error().what, "cancelled");
}

} // namespace
} // namespace blush::test::TEST_FILE
