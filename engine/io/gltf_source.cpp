#include "io/gltf_source.h"

#include "core/files.h"
#include "io/gltf_json.h"
#include "io/gltf_uri.h"

#include <exception>
#include <limits>

namespace blush {
namespace {

// GLB's own length field has 32 bits, and so has the parser's.
constexpr uint64_t max_file_bytes = std::numeric_limits<uint32_t>::max();
constexpr size_t max_findings = 500;

// The parser's only door to the file system. It passes URIs through unjoined (its base folder is empty), so that what
// comes here is what the file says.
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
    if (error) *error += "importing writes nothing";
    return false;
}

// Keeps the encoded bytes; decoding is image_io's. An image in a buffer view is left where it is: the pointer that the
// parser computes for it has not been checked against the buffer's size.
bool keep_encoded(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes, int size, void*) {
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    return true;
}

std::string first_line(const std::string& text) { return text.substr(0, std::min<size_t>(text.find('\n'), 200)); }

} // namespace

void GltfContext::add(Diagnostic::Severity severity, std::string what, std::string where) const {
    if (report.diagnostics.size() < max_findings)
        report.diagnostics.push_back({severity, std::move(what), std::move(where)});
    else if (report.diagnostics.size() == max_findings)
        report.diagnostics.push_back({severity, "more findings than can be listed", ""});
}

Result<GltfSource> load_gltf(const std::filesystem::path& file) {
    const auto failed = [&](const Error& error) { return Error{file.string(), error.what, error.where}; };
    const Result<std::vector<uint8_t>> bytes = read_file(file, max_file_bytes);
    if (!bytes) return bytes.error();
    GltfSource source{file, file.parent_path(), {}, {}};
    const Result<std::string_view> text = gltf_json_text(*bytes);
    if (!text) return failed(text.error());
    if (const auto ok = check_gltf_json(*text, source.folder); !ok) return failed(ok.error());

    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks({file_exists, same_name, read_whole_file, refuse_to_write, &source.folder});
    parser.SetImageLoader(keep_encoded, nullptr);
    std::string error, warning;
    bool parsed = false;
    const bool binary = text->data() != reinterpret_cast<const char*>(bytes->data());
    try {
        parsed = binary ? parser.LoadBinaryFromMemory(&source.model, &error, &warning, bytes->data(), uint32_t(bytes->size()))
                        : parser.LoadASCIIFromString(&source.model, &error, &warning, text->data(), uint32_t(text->size()), "");
    } catch (const std::exception& e) { error = e.what(); }
    if (!parsed) return Error{file.string(), "not a valid glTF file: " + first_line(error), ""};
    source.parser_notes = error + warning;
    return source;
}

} // namespace blush
