#include "io/gltf/read/source.h"

#include "core/files.h"
#include "io/gltf/compression/parser_compatible.h"
#include "io/gltf/read/json.h"
#include "io/gltf/read/uri.h"

#include <nlohmann/json.hpp>

#include <exception>
#include <limits>
#include <optional>

namespace blush {
namespace {

// The length fields of GLB and of the parser have 32 bits.
constexpr uint64_t max_file_bytes = std::numeric_limits<uint32_t>::max();

// The parser's only access to the file system. Its base folder is empty, so that it passes URIs as they are in the file.
Result<std::filesystem::path> resolve(const std::string& uri, void* folder) {
    return resolve_uri(*static_cast<const std::filesystem::path*>(folder), uri);
}

bool file_exists(const std::string& uri, void* folder) {
    const auto file = resolve(uri, folder);
    std::error_code failed;
    return file && std::filesystem::is_regular_file(*file, failed);
}

std::string same_name(const std::string& uri, void*) { return uri; }

bool read_whole_file(std::vector<unsigned char>* out, std::string* error, const std::string& uri, void* folder) {
    const auto file = resolve(uri, folder);
    auto bytes = file ? read_file(*file, max_file_bytes) : Result<std::vector<uint8_t>>(file.error());
    if (!bytes) {
        if (error) *error += bytes.error().text();
        return false;
    }
    *out = *std::move(bytes);
    return true;
}

bool refuse_to_write(std::string* error, const std::string&, const std::vector<unsigned char>&, void*) {
    if (error) *error += "importing must not write files";
    return false;
}

// Keeps the encoded bytes; image_io decodes them. Ignores images in buffer views: the parser does not check their pointer against
// the size of the buffer.
bool keep_encoded(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes, int size, void*) {
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    return true;
}

std::string first_line(const std::string& text) { return text.substr(0, std::min<size_t>(text.find('\n'), 200)); }

bool nothing_exists(const std::string&, void*) { return false; }
bool read_nothing(std::vector<unsigned char>*, std::string*, const std::string&, void*) { return false; }

// The document with primitives without vertices and images without bytes.
nlohmann::json without_payloads(nlohmann::json root) {
    for (const char* list : {"buffers", "bufferViews", "accessors"}) root.erase(list);
    if (const auto meshes = root.find("meshes"); meshes != root.end())
        for (nlohmann::json& mesh : *meshes)
            for (nlohmann::json& primitive : mesh["primitives"]) {
                primitive["attributes"] = nlohmann::json::object();
                for (const char* payload : {"indices", "extensions"}) primitive.erase(payload);
                // Keeps the number of morph targets, which determines the number of weights.
                if (const auto targets = primitive.find("targets"); targets != primitive.end() && targets->is_array())
                    for (nlohmann::json& target : *targets) target = nlohmann::json::object();
            }
    if (const auto images = root.find("images"); images != root.end())
        for (nlohmann::json& image : *images) {
            const std::string uri = image.value("uri", "data:");
            image = {{"name", image.value("name", "")}, {"uri", is_data_uri(uri) ? "embedded" : uri}};
        }
    return root;
}

// The file converted for the parser, if it would reject the original.
std::optional<std::vector<uint8_t>> without_packed_references(const nlohmann::json& root, const std::vector<uint8_t>& file, bool binary) {
    const std::optional<nlohmann::json> changed = parser_compatible(root);
    if (!changed) return {};
    const std::string text = changed->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    if (!binary) return std::vector<uint8_t>(text.begin(), text.end());
    const std::span<const uint8_t> chunk = glb_binary(file);
    return glb_bytes(text, {chunk.begin(), chunk.end()});
}

// Runs tinygltf by `load(parser, &error, &warning)` and keeps its messages.
template <class Load> Result<void> parse(GltfSource& source, const Load& load) {
    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(keep_encoded, nullptr);
    std::string error, warning;
    bool parsed = false;
    try {
        parsed = load(parser, &error, &warning);
    } catch (const std::exception& e) { error = e.what(); }
    if (!parsed) return Error{source.file.string(), "not a valid glTF file: " + first_line(error), ""};
    source.parser_notes = error + warning;
    return {};
}

} // namespace

Result<GltfSource> load_gltf(const std::filesystem::path& file) {
    const auto failed = [&](const Error& error) { return Error{file.string(), error.what, error.where}; };
    const Result<std::vector<uint8_t>> bytes = read_file(file, max_file_bytes);
    if (!bytes) return bytes.error();
    GltfSource source{file, file.parent_path(), {}, {}, {}, {}};
    const Result<std::string_view> text = gltf_json_text(*bytes);
    if (!text) return failed(text.error());
    Result<nlohmann::json> json = check_gltf_json(*text, source.folder);
    if (!json) return failed(json.error());
    source.json = std::make_shared<const nlohmann::json>(*std::move(json));
    source.text = std::make_shared<const std::string>(*text);
    const bool binary = text->data() != reinterpret_cast<const char*>(bytes->data());
    const std::optional<std::vector<uint8_t>> changed = without_packed_references(*source.json, *bytes, binary);
    const std::vector<uint8_t>& parser_compatible = changed ? *changed : *bytes;
    const auto size = uint32_t(parser_compatible.size());
    const auto parsed = parse(source, [&](tinygltf::TinyGLTF& parser, std::string* error, std::string* warning) {
        parser.SetFsCallbacks({file_exists, same_name, read_whole_file, refuse_to_write, &source.folder});
        return binary ? parser.LoadBinaryFromMemory(&source.model, error, warning, parser_compatible.data(), size)
                      : parser.LoadASCIIFromString(&source.model, error, warning, reinterpret_cast<const char*>(parser_compatible.data()),
                                                   size, "");
    });
    if (!parsed) return parsed.error();
    return source;
}

Result<GltfSource> load_gltf_records(const std::string& text) {
    GltfSource source;
    nlohmann::json json = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
    const std::string records = without_payloads(json).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    source.json = std::make_shared<const nlohmann::json>(std::move(json));
    const auto parsed = parse(source, [&](tinygltf::TinyGLTF& parser, std::string* error, std::string* warning) {
        parser.SetFsCallbacks({nothing_exists, same_name, read_nothing, refuse_to_write, nullptr});
        return parser.LoadASCIIFromString(&source.model, error, warning, records.data(), uint32_t(records.size()), "");
    });
    if (!parsed) return parsed.error();
    return source;
}

} // namespace blush
