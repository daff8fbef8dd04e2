// Compressed meshes and buffer views: round trip through the encoder of each library.
#include "io/gltf/write/save.h"
#include "scene/validate.h"
#include "tests/io/gltf/packed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

using Corner = std::array<float, 8>; // position, normal, texture coordinates
using Triangle = std::array<Corner, 3>;

// Sorted, independent of the order of vertices and triangles.
std::vector<Triangle> sorted(std::vector<Triangle> triangles) {
    for (Triangle& t : triangles) std::ranges::rotate(t, std::ranges::min_element(t));
    std::ranges::sort(triangles);
    return triangles;
}
std::vector<Triangle> triangles_of(const Sheet& sheet) {
    std::vector<Triangle> triangles(sheet.indices.size() / 3);
    for (size_t i = 0; i < sheet.indices.size(); ++i) {
        const size_t v = sheet.indices[i];
        const float *p = &sheet.positions[3 * v], *n = &sheet.normals[3 * v], *t = &sheet.uvs[2 * v];
        triangles[i / 3][i % 3] = {p[0], p[1], p[2], n[0], n[1], n[2], t[0], t[1]};
    }
    return sorted(std::move(triangles));
}
std::vector<Triangle> triangles_of(const Scene& scene) {
    std::vector<Triangle> triangles;
    for (const auto& [id, mesh] : scene.meshes)
        for (const auto& part : mesh.parts) {
            const Geometry& g = *part.geometry;
            for (size_t i = 0; i < g.indices.size(); ++i) {
                const size_t v = g.indices[i];
                if (i % 3 == 0) triangles.emplace_back();
                triangles.back()[i % 3] = {g.positions[v].x, g.positions[v].y, g.positions[v].z, g.normals[v].x,
                                           g.normals[v].y,   g.normals[v].z,   g.uv[0][v].x,     g.uv[0][v].y};
            }
        }
    return sorted(std::move(triangles));
}

// In a .gltf and in a .glb.
void expect_read(const GltfBuilder& built, const Sheet& sheet) {
    const TempFolder folder;
    for (const std::string& text : {built.gltf(), built.glb()}) {
        const auto imported = import_text(folder, text);
        ASSERT_TRUE(imported) << error_text(imported);
        EXPECT_EQ(triangles_of(imported->scene), triangles_of(sheet));
        EXPECT_TRUE(imported->report.diagnostics.empty());
        EXPECT_EQ(imported->report.extensions_honoured.size(), 1u);
    }
}

TEST(DracoMesh, IsDecompressedLosslessly) {
    const Sheet sheet(9);
    for (const int speed : {10, 5, 0}) expect_read(packed_by_draco(sheet, draco_bytes(sheet, speed, 0)), sheet);
}

// Coordinates differ by at most half a quantisation step.
TEST(DracoMesh, HasThePrecisionOfItsQuantisation) {
    const Sheet sheet(9);
    constexpr int bits = 12;
    const auto imported = import_built(packed_by_draco(sheet, draco_bytes(sheet, 3, bits)));
    ASSERT_TRUE(imported) << error_text(imported);
    const Geometry& g = *imported->scene.meshes.begin()->value.parts.at(0).geometry;
    EXPECT_EQ(g.triangle_count(), sheet.indices.size() / 3);
    const double half_step = 9.0 / ((1 << bits) - 1) / 2 + 1e-6;
    for (const Vec3& p : g.positions) {
        EXPECT_LE(std::abs(double(p.x) - std::round(double(p.x))), half_step);
        EXPECT_LE(std::abs(double(p.y) - std::round(double(p.y))), half_step);
    }
}

TEST(DracoMesh, UncompressedDataTakesPrecedence) {
    const Sheet sheet(3);
    GltfBuilder b = packed_by_draco(sheet, "these are not read");
    Json& primitive = b.json["meshes"][0]["primitives"][0];
    primitive["attributes"] = {{"POSITION", b.accessor(sheet.positions, "VEC3")},
                               {"NORMAL", b.accessor(sheet.normals, "VEC3")},
                               {"TEXCOORD_0", b.accessor(sheet.uvs, "VEC2")}};
    primitive["indices"] = b.accessor(sheet.indices, "SCALAR");
    expect_read(b, sheet);
}

TEST(DracoMesh, StaysCompressedWhenSaved) {
    const TempFolder folder;
    const Sheet sheet(5);
    const auto imported = import_text(folder, packed_by_draco(sheet, draco_bytes(sheet, 3, 0)).glb());
    ASSERT_TRUE(imported) << error_text(imported);
    Project project{imported->scene, {}, {}};
    const Id<Node> id = project.scene.nodes.begin()->id;
    Node node = *project.scene.nodes.find(id);
    node.local.translation = {1, 2, 3};
    project.scene.nodes.set(id, node);
    for (const char* name : {"saved.glb", "saved.gltf"}) {
        const auto saved = save_gltf(imported->origin, project, folder / name);
        ASSERT_TRUE(saved) << error_text(saved);
        const auto again = import_gltf(folder / name);
        ASSERT_TRUE(again) << error_text(again);
        EXPECT_EQ(triangles_of(again->scene), triangles_of(sheet));
        EXPECT_EQ(again->scene.nodes.find(id)->local.translation, node.local.translation);
        EXPECT_NE(again->origin.json->find(draco_extension), std::string::npos);
    }
}

TEST(MeshoptViews, AreDecompressedLosslessly) {
    const Sheet sheet(11);
    for (const bool sequence : {false, true})
        for (const size_t stride : {size_t(2), size_t(4)})
            expect_read(packed_by_meshopt(sheet, packed_indices(sheet, sequence, stride)), sheet);
}

// Some exporters do not mark the placeholder, or reference a missing buffer.
TEST(MeshoptViews, NeedNoFallback) {
    const Sheet sheet(11);
    GltfBuilder unmarked = packed_by_meshopt(sheet, packed_indices(sheet, false, 4));
    unmarked.further_buffers[0].erase("extensions");
    expect_read(unmarked, sheet);
    GltfBuilder missing = packed_by_meshopt(sheet, packed_indices(sheet, false, 4));
    missing.further_buffers.clear();
    expect_read(missing, sheet);
    for (Json& view : missing.json["bufferViews"])
        if (view.contains("extensions")) view.erase("buffer");
    expect_read(missing, sheet);
}

// Unit vectors as octahedra of 8 bits with a stride of 4, positions as exponents and mantissas of 24 bits.
TEST(MeshoptViews, FiltersAreDecoded) {
    const Sheet sheet(11);
    const size_t n = sheet.vertices();
    std::vector<float> directions;
    for (size_t i = 0; i < n; ++i)
        directions.insert(directions.end(), {sheet.normals[3 * i], sheet.normals[3 * i + 1], sheet.normals[3 * i + 2], 0});
    std::vector<int8_t> octahedra(4 * n);
    meshopt_encodeFilterOct(octahedra.data(), n, 4, 8, directions.data());
    std::vector<float> exponents(3 * n);
    meshopt_encodeFilterExp(exponents.data(), n, 12, 24, sheet.positions.data());
    Stream normals = packed_vertices(octahedra.data(), n, 4), positions = packed_vertices(exponents.data(), n, 12);
    normals.filter = "OCTAHEDRAL";
    positions.filter = "EXPONENTIAL";
    GltfBuilder b;
    begin_meshopt(b);
    b.show(
        {{"attributes",
          {{"POSITION", add_packed_accessor(b, positions, "VEC3", 5126)}, {"NORMAL", add_packed_accessor(b, normals, "VEC3", 5120, true)}}},
         {"indices", add_packed_accessor(b, packed_indices(sheet, false, 4), "SCALAR", 5125)}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    const Geometry& g = *imported->scene.meshes.begin()->value.parts.at(0).geometry;
    ASSERT_EQ(g.positions.size(), n);
    for (size_t i = 0; i < n; ++i) {
        // The exponent is shared by the three of a vertex, whose largest is at most 11.
        EXPECT_NEAR(g.positions[i].x, sheet.positions[3 * i], 16 * 0x1p-23f);
        EXPECT_NEAR(g.positions[i].z, sheet.positions[3 * i + 2], 16 * 0x1p-23f);
        const Vec3 n_i{sheet.normals[3 * i], sheet.normals[3 * i + 1], sheet.normals[3 * i + 2]};
        EXPECT_GT(dot(normalize(g.normals[i]), n_i), std::cos(2.0 / 127)) << "two steps of the octahedron's grid";
    }
}

// Any change of a compressed byte gives an error or a valid scene.
TEST(CompressedGltf, RandomBytesFlipped) {
    const TempFolder folder;
    const Sheet sheet(4);
    std::mt19937 random(2);
    for (const GltfBuilder& built : {packed_by_draco(sheet, draco_bytes(sheet, 0, 10)), packed_by_draco(sheet, draco_bytes(sheet, 10, 10)),
                                     packed_by_meshopt(sheet, packed_indices(sheet, false, 4))}) {
        int refused = 0;
        for (int i = 0; i < 400; ++i) {
            GltfBuilder broken = built;
            for (int flips = 1 + int(random() % 3); flips > 0; --flips) broken.buffer[random() % broken.buffer.size()] = char(random());
            const auto imported = import_text(folder, broken.glb());
            refused += !imported;
            if (!imported) continue;
            const auto valid = validate(imported->scene);
            ASSERT_TRUE(valid) << error_text(valid);
        }
        EXPECT_GT(refused, 0);
    }
}

TEST(CompressedGltf, RefusesImpossibleSizes) {
    const Sheet sheet(4);
    const auto refused = [](const GltfBuilder& b, const char* why) {
        const std::string error = error_text(import_built(b));
        EXPECT_NE(error.find(why), std::string::npos) << error;
    };
    const auto meshopt = [&](const char* key, Json value) {
        GltfBuilder b = packed_by_meshopt(sheet, packed_indices(sheet, false, 4));
        b.json["bufferViews"].back()["extensions"][meshopt_extension][key] = std::move(value);
        return b;
    };
    refused(meshopt("count", 300000000), "cannot describe 300000000 elements");
    refused(meshopt("count", -1), "not valid for the extension");
    refused(meshopt("byteStride", 3), "not valid for the extension");
    refused(meshopt("mode", "SECRET"), "not valid for the extension");
    refused(meshopt("filter", "OCTAHEDRAL"), "not valid for the extension");
    refused(meshopt("buffer", 7), "buffer 7 does not exist");
    refused(meshopt("byteLength", 1 << 30), "reach beyond the buffer");
    refused(meshopt("byteLength", 5), "cannot");

    const std::string whole = draco_bytes(sheet, 0, 10);
    // The number of triangles, behind the number of vertices, as four bytes of seven bits: 2^28 - 1.
    const std::string bomb = whole.substr(0, 13) + "\xff\xff\xff\x7f" + whole.substr(14);
    refused(packed_by_draco(sheet, bomb), "bytes cannot describe 268435455 triangles");
    refused(packed_by_draco(sheet, "DRACO\x01\x01"), "not a Draco mesh");
    refused(packed_by_draco(sheet, whole.substr(0, whole.size() / 2)), "not a valid Draco mesh");
    GltfBuilder no_view = packed_by_draco(sheet, whole);
    no_view.json["meshes"][0]["primitives"][0]["extensions"][draco_extension].erase("bufferView");
    refused(no_view, "buffer view -1 does not exist");
    GltfBuilder no_attribute = packed_by_draco(sheet, whole);
    no_attribute.json["meshes"][0]["primitives"][0]["extensions"][draco_extension]["attributes"]["NORMAL"] = 9;
    refused(no_attribute, "has no attribute 9");
}

} // namespace
} // namespace blush::test::TEST_FILE
