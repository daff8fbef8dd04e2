#include "io/gltf_draco.h"

#include "io/gltf_accessors.h"
#include "io/gltf_extras.h"
#include "io/gltf_object.h"
#include "io/gltf_unpacked.h"

#include <draco/compression/decode.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace blush {
namespace {

constexpr const char* extension_name = "KHR_draco_mesh_compression";

// The library believes what the first bytes say and makes room for it. Even a flat regular grid, its best case, takes more bytes than this.
constexpr uint64_t most_faces_per_byte = 1024;

// The first fields of a mesh (Draco bitstream 2.2, sections 2 and 3), as far as its number of faces.
class Header {
public:
    explicit Header(std::span<const uint8_t> bytes) : bytes_(bytes) {}

    std::optional<uint64_t> faces() {
        constexpr uint8_t mesh = 1, edgebreaker = 1;
        constexpr uint16_t has_metadata = 0x8000; // would stand before the number of faces; no exporter of glTF writes any
        if (bytes_.size() < 12 || std::string_view(reinterpret_cast<const char*>(bytes_.data()), 5) != "DRACO") return {};
        if (bytes_[5] != 2 || bytes_[6] != 2 || bytes_[7] != mesh) return {};
        const uint8_t method = bytes_[8];
        if (uint16_t(bytes_[9] | bytes_[10] << 8) & has_metadata) return {};
        at_ = 11;
        if (method == edgebreaker) {
            ++at_;                    // the traversal's kind
            if (!number()) return {}; // of vertices
        }
        return number();
    }

private:
    // Seven bits a byte, the lowest first.
    std::optional<uint64_t> number() {
        uint64_t value = 0;
        for (int shift = 0; shift < 35 && at_ < bytes_.size(); shift += 7) {
            const uint8_t byte = bytes_[at_++];
            value |= uint64_t(byte & 0x7f) << shift;
            if (!(byte & 0x80)) return value;
        }
        return {};
    }
    std::span<const uint8_t> bytes_;
    size_t at_ = 0;
};

template <class T> bool convert(const draco::PointAttribute& attribute, uint32_t points, int components, std::vector<uint8_t>& out) {
    const size_t size = size_t(components) * sizeof(T);
    out.resize(points * size);
    std::array<T, 4> value;
    for (uint32_t i = 0; i < points; ++i) {
        if (!attribute.ConvertValue<T>(attribute.mapped_index(draco::PointIndex(i)), int8_t(components), value.data())) return false;
        std::memcpy(out.data() + i * size, value.data(), size);
    }
    return true;
}

bool convert(const draco::PointAttribute& attribute, uint32_t points, int components, int component_type, std::vector<uint8_t>& out) {
    switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return convert<int8_t>(attribute, points, components, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return convert<uint8_t>(attribute, points, components, out);
    case TINYGLTF_COMPONENT_TYPE_SHORT: return convert<int16_t>(attribute, points, components, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return convert<uint16_t>(attribute, points, components, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return convert<uint32_t>(attribute, points, components, out);
    case TINYGLTF_COMPONENT_TYPE_FLOAT: return convert<float>(attribute, points, components, out);
    default: return false;
    }
}

Result<std::unique_ptr<draco::Mesh>> decode(const GltfContext& context, int view, const std::string& where) {
    const auto bytes = buffer_view_bytes(context, view, where);
    if (!bytes) return bytes.error();
    const auto faces = Header(*bytes).faces();
    if (!faces) return context.error("not a Draco mesh of bitstream 2.2", where);
    if (*faces > most_faces_per_byte * bytes->size())
        return context.error(fmt::format("{} bytes cannot describe {} triangles", bytes->size(), *faces), where);
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    auto mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok()) return context.error(fmt::format("not a valid Draco mesh: {}", mesh.status().error_msg_string()), where);
    return std::move(mesh).value();
}

std::vector<uint8_t> indices_of(const draco::Mesh& mesh) {
    std::vector<uint8_t> bytes(size_t(mesh.num_faces()) * 3 * sizeof(uint32_t));
    for (uint32_t f = 0; f < mesh.num_faces(); ++f)
        for (size_t corner = 0; corner < 3; ++corner) {
            const uint32_t index = mesh.face(draco::FaceIndex(f))[corner].value();
            std::memcpy(bytes.data() + (3 * size_t(f) + corner) * sizeof index, &index, sizeof index);
        }
    return bytes;
}

struct Unpacker {
    GltfSource& source;
    const GltfContext& context;

    bool has_bytes(int accessor) const {
        return accessor >= 0 && size_t(accessor) < source.model.accessors.size() &&
               source.model.accessors[size_t(accessor)].bufferView >= 0;
    }

    // An accessor of its own: primitives that share one need not have their vertices in the same order.
    Result<int> attribute(const draco::Mesh& mesh, int described, int id, const std::string& where) {
        if (described < 0 || size_t(described) >= source.model.accessors.size())
            return context.error(fmt::format("accessor {} does not exist", described), where);
        const draco::PointAttribute* const values = mesh.GetAttributeByUniqueId(uint32_t(id));
        if (!values) return context.error(fmt::format("the Draco mesh has no attribute {}", id), where);
        tinygltf::Accessor accessor = source.model.accessors[size_t(described)];
        const int components = tinygltf::GetNumComponentsInType(uint32_t(accessor.type));
        std::vector<uint8_t> bytes;
        if (components < 1 || components > 4 || !convert(*values, mesh.num_points(), components, accessor.componentType, bytes))
            return context.error("the Draco attribute does not fit its accessor", where);
        accessor.bufferView = add_unpacked_view(source, std::move(bytes));
        accessor.byteOffset = 0;
        accessor.count = mesh.num_points();
        accessor.sparse.isSparse = false;
        return add(std::move(accessor));
    }

    int indices(const draco::Mesh& mesh) {
        tinygltf::Accessor accessor;
        accessor.bufferView = add_unpacked_view(source, indices_of(mesh));
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        accessor.type = TINYGLTF_TYPE_SCALAR;
        accessor.count = size_t(mesh.num_faces()) * 3;
        return add(std::move(accessor));
    }

    int add(tinygltf::Accessor accessor) {
        source.model.accessors.push_back(std::move(accessor));
        return int(source.model.accessors.size()) - 1;
    }

    Result<void> primitive(tinygltf::Primitive& primitive, const std::string& where) {
        const GltfObject extension = GltfObject(context, primitive.extensions, where + ".extensions").object(extension_name);
        if (!extension) return {};
        const bool uncompressed = has_bytes(primitive.indices) && std::ranges::all_of(primitive.attributes, [&](const auto& attribute) {
                                      return has_bytes(attribute.second);
                                  });
        if (uncompressed) return {};
        const auto mesh = decode(context, extension.integer("bufferView").value_or(-1), extension.where());
        if (!mesh) return mesh.error();
        const GltfObject ids = extension.object("attributes");
        for (auto& [name, accessor] : primitive.attributes) {
            const auto id = ids.integer(name.c_str());
            if (!id) continue;
            const Result<int> unpacked = attribute(**mesh, accessor, *id, where + "." + name.substr(0, 100));
            if (!unpacked) return unpacked.error();
            accessor = *unpacked;
        }
        primitive.indices = indices(**mesh);
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        return {};
    }
};

} // namespace

Result<void> unpack_draco(GltfSource& source, const GltfContext& context) {
    Unpacker unpack{source, context};
    for (size_t m = 0; m < source.model.meshes.size(); ++m)
        for (size_t p = 0; p < source.model.meshes[m].primitives.size(); ++p) {
            if (context.cancelled()) return context.cancel_error();
            if (const auto ok = unpack.primitive(source.model.meshes[m].primitives[p], fmt::format("meshes[{}].primitives[{}]", m, p)); !ok)
                return ok;
        }
    return {};
}

} // namespace blush
