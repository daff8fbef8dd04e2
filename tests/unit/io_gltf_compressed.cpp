// Compressed meshes and buffer views: what they unpack to is what was packed, by either library's own encoder.
#include "core/math.h"
#include "io/gltf_save.h"
#include "io_gltf_builder.h"
#include "scene/validate.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace blush::test {
namespace {

constexpr const char* draco_extension = "KHR_draco_mesh_compression";
constexpr const char* meshopt_extension = "EXT_meshopt_compression";

// A bumpy square of side * side quads, with normals and texture coordinates.
struct Sheet {
    std::vector<float> positions, normals, uvs;
    std::vector<uint32_t> indices;
    size_t vertices() const { return positions.size() / 3; }

    explicit Sheet(uint32_t side) {
        std::mt19937 random(side);
        std::uniform_real_distribution<float> bump(-0.25f, 0.25f);
        for (uint32_t y = 0; y <= side; ++y)
            for (uint32_t x = 0; x <= side; ++x) {
                positions.insert(positions.end(), {float(x), float(y), bump(random)});
                const Vec3 n = normalize(Vec3{bump(random), bump(random), 1});
                normals.insert(normals.end(), {n.x, n.y, n.z});
                uvs.insert(uvs.end(), {float(x) / float(side), float(y) / float(side)});
            }
        for (uint32_t y = 0; y < side; ++y)
            for (uint32_t x = 0; x < side; ++x) {
                const uint32_t a = y * (side + 1) + x, b = a + side + 1;
                indices.insert(indices.end(), {a, a + 1, b, a + 1, b + 1, b});
            }
    }
};

using Corner = std::array<float, 8>; // position, normal, texture coordinates
using Triangle = std::array<Corner, 3>;

// In an order that does not depend on how vertices and triangles were numbered.
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

// Without quantisation, if `bits` is 0.
std::string draco_bytes(const Sheet& sheet, int speed, int bits) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(int(sheet.indices.size() / 3));
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int normal = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
    const int uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    for (size_t f = 0; f < sheet.indices.size() / 3; ++f) {
        const auto set = [&](int attribute, const std::vector<float>& values, size_t components) {
            const auto at = [&](size_t corner) { return values.data() + components * sheet.indices[3 * f + corner]; };
            builder.SetAttributeValuesForFace(attribute, draco::FaceIndex(uint32_t(f)), at(0), at(1), at(2));
        };
        set(position, sheet.positions, 3);
        set(normal, sheet.normals, 3);
        set(uv, sheet.uvs, 2);
    }
    const auto mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetSpeedOptions(speed, speed);
    if (bits > 0)
        for (const auto type : {draco::GeometryAttribute::POSITION, draco::GeometryAttribute::NORMAL, draco::GeometryAttribute::TEX_COORD})
            encoder.SetAttributeQuantization(type, bits);
    draco::EncoderBuffer buffer;
    if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok()) throw std::runtime_error("Draco cannot encode the sheet");
    return {buffer.data(), buffer.size()};
}

// Accessors without bytes, as exporters write them.
GltfBuilder packed_by_draco(const Sheet& sheet, const std::string& bytes) {
    GltfBuilder b;
    const auto accessor = [&](const char* type, size_t count, int component) {
        return b.add("accessors", {{"componentType", component}, {"count", count}, {"type", type}});
    };
    const Json attributes = {{"POSITION", accessor("VEC3", sheet.vertices(), 5126)},
                             {"NORMAL", accessor("VEC3", sheet.vertices(), 5126)},
                             {"TEXCOORD_0", accessor("VEC2", sheet.vertices(), 5126)}};
    const Json packed = {{"bufferView", b.buffer_view(bytes)}, {"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}}}};
    b.show({{"attributes", attributes},
            {"indices", accessor("SCALAR", sheet.indices.size(), 5123)},
            {"extensions", {{draco_extension, packed}}}});
    b.json["extensionsUsed"] = b.json["extensionsRequired"] = {draco_extension};
    return b;
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

TEST(DracoMesh, IsReadToTheBit) {
    const Sheet sheet(9);
    for (const int speed : {10, 5, 0}) expect_read(packed_by_draco(sheet, draco_bytes(sheet, speed, 0)), sheet);
}

// No coordinate is off by more than half a step of the grid that it was rounded to.
TEST(DracoMesh, IsAsPreciseAsItWasQuantised) {
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

TEST(DracoMesh, GivesWayToPlainBytes) {
    const Sheet sheet(3);
    GltfBuilder b = packed_by_draco(sheet, "these are not read");
    Json& primitive = b.json["meshes"][0]["primitives"][0];
    primitive["attributes"] = {{"POSITION", b.accessor(sheet.positions, "VEC3")},
                               {"NORMAL", b.accessor(sheet.normals, "VEC3")},
                               {"TEXCOORD_0", b.accessor(sheet.uvs, "VEC2")}};
    primitive["indices"] = b.accessor(sheet.indices, "SCALAR");
    expect_read(b, sheet);
}

TEST(DracoMesh, StaysPackedWhenItIsSaved) {
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

struct Stream {
    std::string bytes, mode;
    size_t count, stride;
    const char* filter = "NONE";
};

Stream packed_vertices(const void* values, size_t count, size_t stride) {
    std::string bytes(meshopt_encodeVertexBufferBound(count, stride), '\0');
    bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), values, count, stride));
    return {bytes, "ATTRIBUTES", count, stride};
}
Stream packed_indices(const Sheet& sheet, bool sequence, size_t stride) {
    const size_t count = sheet.indices.size();
    const auto bound = sequence ? meshopt_encodeIndexSequenceBound : meshopt_encodeIndexBufferBound;
    std::string bytes(bound(count, sheet.vertices()), '\0');
    auto* const data = reinterpret_cast<unsigned char*>(bytes.data());
    bytes.resize(sequence ? meshopt_encodeIndexSequence(data, bytes.size(), sheet.indices.data(), count)
                          : meshopt_encodeIndexBuffer(data, bytes.size(), sheet.indices.data(), count));
    return {bytes, sequence ? "INDICES" : "TRIANGLES", count, stride};
}

// A view that says what it unpacks to, of a buffer that is not there.
int add_packed_view(GltfBuilder& b, const Stream& s) {
    Json view = b.json["bufferViews"].at(size_t(b.buffer_view(s.bytes)));
    b.json["bufferViews"].erase(b.json["bufferViews"].size() - 1);
    Json packed = {{"buffer", 0},
                   {"byteOffset", view["byteOffset"]},
                   {"byteLength", s.bytes.size()},
                   {"byteStride", s.stride},
                   {"count", s.count},
                   {"mode", s.mode},
                   {"filter", s.filter}};
    return b.add("bufferViews",
                 {{"buffer", 1}, {"byteLength", s.count * s.stride}, {"extensions", {{meshopt_extension, std::move(packed)}}}});
}
int add_packed_accessor(GltfBuilder& b, const Stream& s, const char* type, int component_type, bool normalized = false) {
    Json accessor = {{"bufferView", add_packed_view(b, s)}, {"componentType", component_type}, {"count", s.count}, {"type", type}};
    if (normalized) accessor["normalized"] = true;
    return b.add("accessors", std::move(accessor));
}
void begin_meshopt(GltfBuilder& b) {
    b.further_buffers.push_back({{"byteLength", 1 << 20}, {"extensions", {{meshopt_extension, {{"fallback", true}}}}}});
    b.json["extensionsUsed"] = b.json["extensionsRequired"] = {meshopt_extension};
}

GltfBuilder packed_by_meshopt(const Sheet& sheet, const Stream& indices) {
    GltfBuilder b;
    begin_meshopt(b);
    const size_t n = sheet.vertices();
    const Json attributes = {{"POSITION", add_packed_accessor(b, packed_vertices(sheet.positions.data(), n, 12), "VEC3", 5126)},
                             {"NORMAL", add_packed_accessor(b, packed_vertices(sheet.normals.data(), n, 12), "VEC3", 5126)},
                             {"TEXCOORD_0", add_packed_accessor(b, packed_vertices(sheet.uvs.data(), n, 8), "VEC2", 5126)}};
    b.show({{"attributes", attributes}, {"indices", add_packed_accessor(b, indices, "SCALAR", indices.stride == 2 ? 5123 : 5125)}});
    return b;
}

TEST(MeshoptViews, AreReadToTheBit) {
    const Sheet sheet(11);
    for (const bool sequence : {false, true})
        for (const size_t stride : {size_t(2), size_t(4)})
            expect_read(packed_by_meshopt(sheet, packed_indices(sheet, sequence, stride)), sheet);
}

// Unit vectors as octahedra of 8 bits with a stride of 4, positions as exponents and mantissas of 24 bits.
TEST(MeshoptViews, OfFilteredNumbersAreReadAsTheEncoderRoundedThem) {
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

// Whatever becomes of a packed byte, it is an error or a scene that can be shown.
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

TEST(CompressedGltf, SaysWhatItsBytesCannotHold) {
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
    refused(meshopt("count", -1), "not what the extension knows");
    refused(meshopt("byteStride", 3), "not what the extension knows");
    refused(meshopt("mode", "SECRET"), "not what the extension knows");
    refused(meshopt("filter", "OCTAHEDRAL"), "not what the extension knows");
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
} // namespace blush::test
