#include "io/gltf_unpacked.h"

#include "io/gltf_draco.h"
#include "io/gltf_extras.h"
#include "io/gltf_meshopt.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace blush {
namespace {

const ParsedGltf& extension(const ParsedGltf& object, std::string_view name) {
    return gltf_member(gltf_member(object, "extensions"), name);
}

bool stands_for_nothing(const ParsedGltf& buffer) {
    return gltf_member(buffer, "uri").is_null() && gltf_member(extension(buffer, "EXT_meshopt_compression"), "fallback") == true;
}

// The parser wants the indices' accessor to have bytes. Unpacking gives new ones.
bool has_packed_indices(const ParsedGltf& root, const ParsedGltf& primitive) {
    const ParsedGltf& indices = gltf_member(primitive, "indices");
    return extension(primitive, "KHR_draco_mesh_compression").is_object() && indices.is_number_unsigned() &&
           gltf_member(gltf_item(root, "accessors", indices.get<size_t>()), "bufferView").is_null();
}

// The parser knows few kinds of data URI, and takes others for names of files. What is in them is told by their bytes.
constexpr std::string_view data_scheme = "data:", data_encoding = ";base64,", data_of_no_kind = "data:application/octet-stream;base64,";
bool has_strange_data(const ParsedGltf& object) {
    const ParsedGltf& uri = gltf_member(object, "uri");
    if (!uri.is_string()) return false;
    const std::string_view text = uri.get_ref<const std::string&>();
    if (!text.starts_with(data_scheme) || text.find(data_encoding) == text.npos) return false;
    return !text.starts_with("data:image/png;base64,") && !text.starts_with("data:image/jpeg;base64,") &&
           !text.starts_with(data_of_no_kind);
}

// Calls visit(object) for each object of a list that is one.
template <class Root, class Visit> void each(Root& object, const char* list, const Visit& visit) {
    if (!object.is_object()) return;
    const auto found = object.find(list);
    if (found == object.end() || !found->is_array()) return;
    for (auto& element : *found) visit(element);
}

} // namespace

std::optional<nlohmann::json> parsable(const nlohmann::json& root) {
    bool refused = false;
    each(root, "buffers", [&](const ParsedGltf& buffer) { refused = refused || stands_for_nothing(buffer); });
    each(root, "images", [&](const ParsedGltf& image) { refused = refused || has_strange_data(image); });
    each(root, "meshes", [&](const ParsedGltf& mesh) {
        each(mesh, "primitives", [&](const ParsedGltf& primitive) { refused = refused || has_packed_indices(root, primitive); });
    });
    if (!refused) return {};
    nlohmann::json changed = root;
    each(changed, "buffers", [](ParsedGltf& buffer) {
        if (!stands_for_nothing(buffer)) return;
        buffer["uri"] = "data:application/octet-stream;base64,AA==";
        buffer["byteLength"] = 1;
    });
    each(changed, "images", [](ParsedGltf& image) {
        if (!has_strange_data(image)) return;
        const std::string& uri = image["uri"].get_ref<const std::string&>();
        image["uri"] = std::string(data_of_no_kind) + uri.substr(uri.find(data_encoding) + data_encoding.size());
    });
    each(changed, "meshes", [&](ParsedGltf& mesh) {
        each(mesh, "primitives", [&](ParsedGltf& primitive) {
            if (has_packed_indices(root, primitive)) primitive.erase("indices");
        });
    });
    return changed;
}

Result<void> unpack(GltfSource& source, const ImportOptions& options, ImportReport& report) {
    const GltfContext context{source, options, report};
    UnpackingRoom room(source.model);
    if (const auto ok = unpack_meshopt(source, context, room); !ok) return ok;
    return unpack_draco(source, context, room);
}

UnpackingRoom::UnpackingRoom(const tinygltf::Model& model) {
    for (const tinygltf::Buffer& buffer : model.buffers) packed_ += double(buffer.data.size());
}

Result<void> UnpackingRoom::take(const GltfContext& context, double bytes, const char* where) {
    constexpr double free_bytes = 512e6, most_per_byte = 128; // scans take one byte in forty, flat grids hardly any
    taken_ += bytes;
    if (taken_ <= free_bytes + most_per_byte * packed_) return {};
    return context.error(
        fmt::format("its compressed data would unpack to {:.0f} MB, but its buffers have {:.3g}", taken_ / 1e6, packed_ / 1e6), where);
}

int add_unpacked_buffer(GltfSource& source, std::vector<uint8_t> bytes) {
    tinygltf::Buffer buffer;
    buffer.data = std::move(bytes);
    source.model.buffers.push_back(std::move(buffer));
    return int(source.model.buffers.size()) - 1;
}

int add_unpacked_view(GltfSource& source, std::vector<uint8_t> bytes) {
    tinygltf::BufferView view;
    view.byteLength = bytes.size();
    view.buffer = add_unpacked_buffer(source, std::move(bytes));
    source.model.bufferViews.push_back(std::move(view));
    return int(source.model.bufferViews.size()) - 1;
}

} // namespace blush
