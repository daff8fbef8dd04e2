#include "io/gltf/compression/draco.h"

#include "io/gltf/compression/decompressed_data.h"
#include "io/gltf/compression/extension_names.h"
#include "io/gltf/read/extras.h"
#include "io/gltf/read/geometry/accessors.h"
#include "io/gltf/read/geometry/parallel_read.h"
#include "io/gltf/read/object.h"

#include <draco/compression/decode.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace blush {
namespace {

// The library allocates what the header announces. Even a flat regular grid, the best case, needs more bytes per triangle than
// this.
constexpr uint64_t max_faces_per_byte = 1024;

// Reads the header of a mesh (Draco bitstream 2.2, sections 2 and 3) up to the number of faces.
class Header {
public:
    explicit Header(std::span<const uint8_t> bytes) : bytes_(bytes) {}

    std::optional<uint64_t> faces() {
        constexpr uint8_t mesh = 1, edgebreaker = 1;
        constexpr uint16_t has_metadata = 0x8000; // metadata would precede the number of faces; glTF exporters write none
        if (bytes_.size() < 12 || std::string_view(reinterpret_cast<const char*>(bytes_.data()), 5) != "DRACO") return {};
        if (bytes_[5] != 2 || bytes_[6] != 2 || bytes_[7] != mesh) return {};
        const uint8_t method = bytes_[8];
        if (uint16_t(bytes_[9] | bytes_[10] << 8) & has_metadata) return {};
        at_ = 11;
        if (method == edgebreaker) {
            ++at_;                    // traversal method
            if (!number()) return {}; // number of vertices
        }
        return number();
    }

private:
    // Varint: seven bits per byte, lowest first.
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
    if (attribute.data_type() == draco::DT_BOOL) return false; // not in glTF; Draco reads any byte value as a bool
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

struct Attribute {
    std::string name;
    int accessor = 0, id = 0; // glTF accessor; attribute id in the Draco mesh
    std::vector<uint8_t> decompressed = {};
};

// A primitive to decompress, and the result.
struct Packed {
    tinygltf::Primitive* primitive;
    std::string where;
    std::span<const uint8_t> bytes;
    std::vector<Attribute> attributes = {};
    std::vector<uint8_t> indices = {};
    size_t points = 0;
};

const tinygltf::Accessor* accessor_at(const tinygltf::Model& model, int index) {
    return index >= 0 && size_t(index) < model.accessors.size() ? &model.accessors[size_t(index)] : nullptr;
}

bool needs_decompression(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
    const auto has_bytes = [&](int index) {
        const tinygltf::Accessor* const accessor = accessor_at(model, index);
        return accessor && accessor->bufferView >= 0;
    };
    return !has_bytes(primitive.indices) ||
           !std::ranges::all_of(primitive.attributes, [&](const auto& attribute) { return has_bytes(attribute.second); });
}

// Bytes per vertex of an accessor; none if its type is not allowed for a mesh.
size_t element_bytes(const tinygltf::Accessor& accessor) {
    const int components = tinygltf::GetNumComponentsInType(uint32_t(accessor.type));
    const int size = tinygltf::GetComponentSizeInBytes(uint32_t(accessor.componentType));
    return components < 1 || components > 4 || size < 1 ? 0 : size_t(components) * size_t(size);
}

// Checks the JSON and the Draco header before allocation.
struct PackedMeshes {
    const GltfContext& context;
    DecompressionLimit& room;
    std::vector<Packed> found = {};
    std::vector<int64_t> sizes = {}; // decompressed, for as many vertices as triangles; the library allows three times as many

    Result<void> add(tinygltf::Primitive& primitive, const std::string& where) {
        const GltfObject extension = GltfObject(context, primitive.extensions, where + ".extensions").object(draco_extension);
        if (!extension || !needs_decompression(context.model(), primitive)) return {};
        const auto bytes = buffer_view_bytes(context, extension.integer("bufferView").value_or(-1), extension.where());
        if (!bytes) return bytes.error();
        const auto faces = Header(*bytes).faces();
        if (!faces) return context.error("not a Draco mesh of bitstream 2.2", extension.where());
        if (*faces > max_faces_per_byte * bytes->size())
            return context.error(fmt::format("{} bytes cannot describe {} triangles", bytes->size(), *faces), extension.where());
        Packed packed{&primitive, where, *bytes};
        const GltfObject ids = extension.object("attributes");
        size_t vertex = 0;
        for (const auto& [name, index] : primitive.attributes) {
            const auto id = ids.integer(name.c_str());
            if (!id) continue;
            const tinygltf::Accessor* const accessor = accessor_at(context.model(), index);
            if (!accessor) return context.error(fmt::format("accessor {} does not exist", index), where + "." + name.substr(0, 100));
            vertex += element_bytes(*accessor);
            packed.attributes.push_back({name, index, *id});
        }
        const double size = double(*faces) * double(3 * sizeof(uint32_t) + vertex);
        if (const auto ok = room.take(context, size, "meshes"); !ok) return ok;
        found.push_back(std::move(packed));
        sizes.push_back(int64_t(size));
        return {};
    }
};

std::vector<uint8_t> indices_of(const draco::Mesh& mesh) {
    std::vector<uint8_t> bytes(size_t(mesh.num_faces()) * 3 * sizeof(uint32_t));
    for (uint32_t f = 0; f < mesh.num_faces(); ++f)
        for (size_t corner = 0; corner < 3; ++corner) {
            const uint32_t index = mesh.face(draco::FaceIndex(f))[corner].value();
            std::memcpy(bytes.data() + (3 * size_t(f) + corner) * sizeof index, &index, sizeof index);
        }
    return bytes;
}

// Thread-safe for distinct primitives.
Result<void> decompress(const GltfContext& context, Packed& packed) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(packed.bytes.data()), packed.bytes.size());
    const auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        return context.error(fmt::format("not a valid Draco mesh: {}", decoded.status().error_msg_string()),
                             fmt::format("{}.extensions.{}", packed.where, draco_extension));
    const draco::Mesh& mesh = *decoded.value();
    for (Attribute& attribute : packed.attributes) {
        const std::string where = packed.where + "." + attribute.name.substr(0, 100);
        const draco::PointAttribute* const values = mesh.GetAttributeByUniqueId(uint32_t(attribute.id));
        if (!values) return context.error(fmt::format("the Draco mesh has no attribute {}", attribute.id), where);
        const tinygltf::Accessor& described = *accessor_at(context.model(), attribute.accessor);
        const int components = tinygltf::GetNumComponentsInType(uint32_t(described.type));
        if (element_bytes(described) == 0 ||
            !convert(*values, mesh.num_points(), components, described.componentType, attribute.decompressed))
            return context.error("the Draco attribute does not match its accessor", where);
    }
    packed.indices = indices_of(mesh);
    packed.points = mesh.num_points();
    return {};
}

int add(GltfSource& source, tinygltf::Accessor accessor, size_t count, std::vector<uint8_t> bytes) {
    accessor.bufferView = add_decompressed_view(source, std::move(bytes));
    accessor.byteOffset = 0;
    accessor.count = count;
    accessor.sparse.isSparse = false;
    source.model.accessors.push_back(std::move(accessor));
    return int(source.model.accessors.size()) - 1;
}

// Adds new accessors: primitives that share one may have different vertex orders.
void take_decompressed(GltfSource& source, Packed& packed) {
    for (Attribute& attribute : packed.attributes)
        packed.primitive->attributes[attribute.name] =
            add(source, *accessor_at(source.model, attribute.accessor), packed.points, std::move(attribute.decompressed));
    tinygltf::Accessor indices;
    indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    indices.type = TINYGLTF_TYPE_SCALAR;
    const size_t corners = packed.indices.size() / sizeof(uint32_t);
    packed.primitive->indices = add(source, std::move(indices), corners, std::move(packed.indices));
    packed.primitive->mode = TINYGLTF_MODE_TRIANGLES;
}

} // namespace

Result<void> decompress_draco(GltfSource& source, const GltfContext& context, DecompressionLimit& room) {
    constexpr int64_t large = int64_t(1) << 26; // bytes: the decoder needs several times as much
    PackedMeshes packed{context, room};
    for (size_t m = 0; m < source.model.meshes.size(); ++m)
        for (size_t p = 0; p < source.model.meshes[m].primitives.size(); ++p)
            if (const auto ok = packed.add(source.model.meshes[m].primitives[p], fmt::format("meshes[{}].primitives[{}]", m, p)); !ok)
                return ok;
    const auto read = read_in_parallel(context, {packed.sizes, large, "decompressing", 0.1, 0.3, context.options.threads},
                                       [&](const GltfContext& own, size_t i) { return decompress(own, packed.found[i]); });
    if (!read) return read;
    for (Packed& each : packed.found) take_decompressed(source, each);
    return {};
}

} // namespace blush
