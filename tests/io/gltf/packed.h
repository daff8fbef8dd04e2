// Files with meshes compressed by the encoders of Draco and meshoptimizer.
#pragma once

#include "core/math.h"
#include "tests/io/gltf/builder.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace blush::test {

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

// Without quantisation, if `bits` is 0.
inline std::string draco_bytes(const Sheet& sheet, int speed, int bits) {
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

// Adds a mesh and its node. Accessors are without bytes, as exporters write them.
inline void show_packed_by_draco(GltfBuilder& b, const Sheet& sheet, const std::string& bytes) {
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
}
inline GltfBuilder packed_by_draco(const Sheet& sheet, const std::string& bytes) {
    GltfBuilder b;
    show_packed_by_draco(b, sheet, bytes);
    b.json["extensionsUsed"] = b.json["extensionsRequired"] = {draco_extension};
    return b;
}

struct Stream {
    std::string bytes, mode;
    size_t count, stride;
    const char* filter = "NONE";
};

inline Stream packed_vertices(const void* values, size_t count, size_t stride) {
    std::string bytes(meshopt_encodeVertexBufferBound(count, stride), '\0');
    bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), values, count, stride));
    return {bytes, "ATTRIBUTES", count, stride};
}
inline Stream packed_indices(const Sheet& sheet, bool sequence, size_t stride) {
    const size_t count = sheet.indices.size();
    const auto bound = sequence ? meshopt_encodeIndexSequenceBound : meshopt_encodeIndexBufferBound;
    std::string bytes(bound(count, sheet.vertices()), '\0');
    auto* const data = reinterpret_cast<unsigned char*>(bytes.data());
    bytes.resize(sequence ? meshopt_encodeIndexSequence(data, bytes.size(), sheet.indices.data(), count)
                          : meshopt_encodeIndexBuffer(data, bytes.size(), sheet.indices.data(), count));
    return {bytes, sequence ? "INDICES" : "TRIANGLES", count, stride};
}

// A compressed view of a placeholder buffer.
inline int add_packed_view(GltfBuilder& b, const Stream& s) {
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
inline int add_packed_accessor(GltfBuilder& b, const Stream& s, const char* type, int component_type, bool normalized = false) {
    Json accessor = {{"bufferView", add_packed_view(b, s)}, {"componentType", component_type}, {"count", s.count}, {"type", type}};
    if (normalized) accessor["normalized"] = true;
    return b.add("accessors", std::move(accessor));
}
inline void begin_meshopt(GltfBuilder& b) {
    b.further_buffers.push_back({{"byteLength", 1 << 20}, {"extensions", {{meshopt_extension, {{"fallback", true}}}}}});
    b.json["extensionsUsed"] = b.json["extensionsRequired"] = {meshopt_extension};
}

inline void show_packed_by_meshopt(GltfBuilder& b, const Sheet& sheet, const Stream& indices) {
    const size_t n = sheet.vertices();
    const Json attributes = {{"POSITION", add_packed_accessor(b, packed_vertices(sheet.positions.data(), n, 12), "VEC3", 5126)},
                             {"NORMAL", add_packed_accessor(b, packed_vertices(sheet.normals.data(), n, 12), "VEC3", 5126)},
                             {"TEXCOORD_0", add_packed_accessor(b, packed_vertices(sheet.uvs.data(), n, 8), "VEC2", 5126)}};
    b.show({{"attributes", attributes}, {"indices", add_packed_accessor(b, indices, "SCALAR", indices.stride == 2 ? 5123 : 5125)}});
}
inline GltfBuilder packed_by_meshopt(const Sheet& sheet, const Stream& indices) {
    GltfBuilder b;
    begin_meshopt(b);
    show_packed_by_meshopt(b, sheet, indices);
    return b;
}

} // namespace blush::test
