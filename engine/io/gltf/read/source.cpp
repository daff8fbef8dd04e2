#include "io/gltf/read/source.h"

#include "core/files.h"
#include "io/gltf/compression/parser_compatible.h"
#include "io/gltf/read/json.h"
#include "io/gltf/read/json_members.h"
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

// The bytes of buffer 0 if the parser would do nothing but copy them, and copying costs more than writing the JSON again: a large
// binary chunk that is the only buffer without a URI. Else empty.
std::span<const uint8_t> large_binary(const nlohmann::json& root, std::span<const uint8_t> chunk, size_t json_bytes) {
    constexpr size_t bytes_per_json_byte = 16;
    if (chunk.size() / bytes_per_json_byte < json_bytes) return {};
    const ParsedGltf& buffers = gltf_member(root, "buffers");
    for (size_t i = 0; i < buffers.size(); ++i) {
        const ParsedGltf& uri = gltf_member(gltf_item(root, "buffers", i), "uri");
        if (i == 0 ? !uri.is_null() : !uri.is_string()) return {};
    }
    const ParsedGltf& length = gltf_member(gltf_item(root, "buffers", 0), "byteLength");
    if (!length.is_number_unsigned() || length.get<uint64_t>() > chunk.size()) return {};
    return chunk.first(length.get<size_t>());
}

// What the parser reads: the file, or its document with changes, and the chunk beside it for a GLB that is not read in place.
struct ParserInput {
    std::optional<std::string> text;         // changed; none: the file is read as it is
    std::optional<std::vector<uint8_t>> glb; // with the changed text
};

ParserInput parser_input(GltfSource& source, const std::vector<uint8_t>& file, bool is_glb, size_t json_bytes) {
    std::optional<nlohmann::json> changed = parser_compatible(*source.json);
    const std::span<const uint8_t> chunk = is_glb ? glb_binary(file) : std::span<const uint8_t>();
    source.binary = large_binary(changed ? *changed : *source.json, chunk, json_bytes);
    if (!source.binary.empty()) {
        if (!changed) changed = *source.json;
        set_placeholder((*changed)["buffers"][0]);
    }
    if (!changed) return {};
    std::string text = changed->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    if (!is_glb || !source.binary.empty()) return {std::move(text), {}};
    return {{}, glb_bytes(text, {chunk.begin(), chunk.end()})};
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

std::span<const uint8_t> GltfSource::buffer_bytes(size_t index) const {
    return index == 0 && !binary.empty() ? binary : std::span<const uint8_t>(model.buffers[index].data);
}

double GltfSource::bytes_in_buffers() const {
    double sum = 0;
    for (size_t i = 0; i < model.buffers.size(); ++i) sum += double(buffer_bytes(i).size());
    return sum;
}

Result<GltfSource> load_gltf(const std::filesystem::path& file) {
    const auto failed = [&](const Error& error) { return Error{file.string(), error.what, error.where}; };
    Result<std::vector<uint8_t>> read = read_file(file, max_file_bytes);
    if (!read) return read.error();
    auto bytes = std::make_shared<const std::vector<uint8_t>>(*std::move(read));
    GltfSource source{.file = file, .folder = file.parent_path(), .model = {}, .parser_notes = {}, .text = {}, .json = {}};
    const Result<std::string_view> text = gltf_json_text(*bytes);
    if (!text) return failed(text.error());
    Result<nlohmann::json> json = check_gltf_json(*text, source.folder);
    if (!json) return failed(json.error());
    source.json = std::make_shared<const nlohmann::json>(*std::move(json));
    source.text = std::make_shared<const std::string>(*text);
    const bool is_glb = text->data() != reinterpret_cast<const char*>(bytes->data());
    const ParserInput input = parser_input(source, *bytes, is_glb, text->size());
    const auto parsed = parse(source, [&](tinygltf::TinyGLTF& parser, std::string* error, std::string* warning) {
        parser.SetFsCallbacks({file_exists, same_name, read_whole_file, refuse_to_write, &source.folder});
        const std::vector<uint8_t>& whole = input.glb ? *input.glb : *bytes;
        if (is_glb && !input.text) return parser.LoadBinaryFromMemory(&source.model, error, warning, whole.data(), uint32_t(whole.size()));
        const std::string_view json_text = input.text ? std::string_view(*input.text) : *text;
        return parser.LoadASCIIFromString(&source.model, error, warning, json_text.data(), uint32_t(json_text.size()), "");
    });
    if (!parsed) return parsed.error();
    if (!source.binary.empty()) source.whole_file = std::move(bytes);
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
