#include "io/gltf/compression/parser_compatible.h"

#include "io/gltf/compression/extension_names.h"
#include "io/gltf/read/json_members.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace blush {
namespace {

const ParsedGltf& extension(const ParsedGltf& object, std::string_view name) {
    return gltf_member(gltf_member(object, "extensions"), name);
}

// Calls visit(object) for each object of a list that is one.
template <class Root, class Visit> void each(Root& object, const char* list, const Visit& visit) {
    if (!object.is_object()) return;
    const auto found = object.find(list);
    if (found == object.end() || !found->is_array()) return;
    for (auto& element : *found) visit(element);
}

// Placeholder buffers without bytes: those marked as fallback, and those without a URI that only compressed views use.
std::vector<bool> placeholder_buffers(const ParsedGltf& root) {
    const ParsedGltf& buffers = gltf_member(root, "buffers");
    std::vector<bool> compressed_use(buffers.size()), own_use(buffers.size());
    const auto note = [&](std::vector<bool>& uses, const ParsedGltf& index) {
        if (index.is_number_unsigned() && index.get<size_t>() < uses.size()) uses[index.get<size_t>()] = true;
    };
    each(root, "bufferViews", [&](const ParsedGltf& view) {
        const ParsedGltf& packed = extension(view, meshopt_extension);
        note(packed.is_object() ? compressed_use : own_use, gltf_member(view, "buffer"));
        note(own_use, gltf_member(packed, "buffer"));
    });
    std::vector<bool> placeholders(buffers.size());
    for (size_t i = 0; i < buffers.size(); ++i) {
        const bool says_so = gltf_member(extension(gltf_item(root, "buffers", i), meshopt_extension), "fallback") == true;
        placeholders[i] = gltf_member(gltf_item(root, "buffers", i), "uri").is_null() && (says_so || (compressed_use[i] && !own_use[i]));
    }
    return placeholders;
}

// A compressed view without a valid buffer. The parser requires one; decompression replaces it.
bool lacks_buffer(const ParsedGltf& root, const ParsedGltf& view) {
    const ParsedGltf& buffer = gltf_member(view, "buffer");
    return extension(view, meshopt_extension).is_object() &&
           !(buffer.is_number_unsigned() && buffer.get<size_t>() < gltf_member(root, "buffers").size());
}

// The parser requires the index accessor to have bytes; decompression adds new indices.
bool has_packed_indices(const ParsedGltf& root, const ParsedGltf& primitive) {
    const ParsedGltf& indices = gltf_member(primitive, "indices");
    return extension(primitive, draco_extension).is_object() && indices.is_number_unsigned() &&
           gltf_member(gltf_item(root, "accessors", indices.get<size_t>()), "bufferView").is_null();
}

// The parser takes data URIs of unknown MIME types for file names. The image format is detected from the bytes.
constexpr std::string_view data_scheme = "data:", data_encoding = ";base64,", data_of_no_kind = "data:application/octet-stream;base64,";
bool has_strange_data(const ParsedGltf& object) {
    const ParsedGltf& uri = gltf_member(object, "uri");
    if (!uri.is_string()) return false;
    const std::string_view text = uri.get_ref<const std::string&>();
    if (!text.starts_with(data_scheme) || text.find(data_encoding) == text.npos) return false;
    return !text.starts_with("data:image/png;base64,") && !text.starts_with("data:image/jpeg;base64,") &&
           !text.starts_with(data_of_no_kind);
}

} // namespace

void set_placeholder(nlohmann::json& buffer) {
    buffer["uri"] = "data:application/octet-stream;base64,AA==";
    buffer["byteLength"] = 1;
}

std::optional<nlohmann::json> parser_compatible(const nlohmann::json& root) {
    bool refused = false;
    const std::vector<bool> placeholders = placeholder_buffers(root);
    refused = std::ranges::count(placeholders, true) > 0;
    each(root, "bufferViews", [&](const ParsedGltf& view) { refused = refused || lacks_buffer(root, view); });
    each(root, "images", [&](const ParsedGltf& image) { refused = refused || has_strange_data(image); });
    each(root, "meshes", [&](const ParsedGltf& mesh) {
        each(mesh, "primitives", [&](const ParsedGltf& primitive) { refused = refused || has_packed_indices(root, primitive); });
    });
    if (!refused) return {};
    nlohmann::json changed = root;
    for (size_t i = 0; i < placeholders.size(); ++i)
        if (placeholders[i]) set_placeholder(changed["buffers"][i]);
    each(changed, "bufferViews", [&](ParsedGltf& view) {
        if (lacks_buffer(root, view)) view["buffer"] = gltf_member(extension(view, meshopt_extension), "buffer");
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

} // namespace blush
