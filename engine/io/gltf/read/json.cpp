#include "io/gltf/read/json.h"

#include "io/gltf/read/extensions.h"
#include "io/gltf/read/uri.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

namespace blush {
namespace {

using nlohmann::json;

constexpr uint32_t json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
constexpr int max_nesting = 64;
constexpr size_t max_members = 10000;

// Byte offset of the bracket that exceeds the nesting limit, or npos. Skips brackets inside strings.
size_t too_deep_at(std::string_view text) {
    int depth = 0;
    bool in_string = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            if (++depth > max_nesting) return i;
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return std::string_view::npos;
}

// Recursion is safe: nesting is limited before.
bool has_huge_object(const json& value) {
    if (value.is_object() && value.size() > max_members) return true;
    return value.is_structured() && std::any_of(value.begin(), value.end(), has_huge_object);
}

// The member if `object` is an object that has it, else null.
const json& member(const json& object, const char* key) {
    static const json null;
    const auto it = object.find(key);
    return it == object.end() ? null : *it;
}

Result<void> check_version(const json& root) {
    const json& version = member(member(root, "asset"), "version");
    if (!version.is_string()) return Error{"", "not a glTF file: it has no asset version", "asset.version"};
    if (!version.get_ref<const std::string&>().starts_with("2."))
        return Error{"", fmt::format("glTF version {} is not supported, only 2.x", version.get_ref<const std::string&>().substr(0, 20)),
                     "asset.version"};
    const json& least = member(member(root, "asset"), "minVersion");
    if (least.is_string() && least != "2.0")
        return Error{"", fmt::format("requires glTF version {}, only 2.0 is supported", least.get_ref<const std::string&>().substr(0, 20)),
                     "asset.minVersion"};
    return {};
}

Result<void> check_required_extensions(const json& root) {
    const json& required = member(root, "extensionsRequired");
    for (size_t i = 0; i < required.size() && required.is_array(); ++i) {
        if (!required[i].is_string()) continue;
        const std::string& name = required[i].get_ref<const std::string&>();
        if (extension_support(name).kind == ExtensionSupport::Kind::ignored)
            return Error{"", fmt::format("needs {}, which this version cannot read", name.substr(0, 100)),
                         fmt::format("extensionsRequired[{}]", i)};
    }
    return {};
}

Result<void> check_uris(const json& root, const char* list, const std::filesystem::path& folder) {
    const json& items = member(root, list);
    for (size_t i = 0; i < items.size() && items.is_array(); ++i) {
        const json& uri = member(items[i], "uri");
        if (!uri.is_string() || is_data_uri(uri.get_ref<const std::string&>())) continue;
        if (const auto file = resolve_uri(folder, percent_decoded(uri.get_ref<const std::string&>())); !file)
            return Error{"", file.error().what, fmt::format("{}[{}].uri", list, i)};
    }
    return {};
}

// Little-endian, as GLB is.
uint32_t word_at(std::span<const uint8_t> bytes, size_t offset) {
    uint32_t word;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

void append_word(std::vector<uint8_t>& bytes, uint64_t word) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(uint8_t(word >> shift));
}

// glTF 2.0, 4.4: a header of 12 bytes, then chunks of (length, type, bytes); the first is JSON, a second may be binary.
Result<std::string_view> glb_json_text(std::span<const uint8_t> bytes) {
    constexpr size_t header = 12, chunk_header = 8;
    if (bytes.size() < header + chunk_header)
        return Error{"", "truncated: shorter than a GLB header", fmt::format("byte {}", bytes.size())};
    if (word_at(bytes, 4) != 2) return Error{"", fmt::format("GLB version {} is not supported, only 2", word_at(bytes, 4)), "byte 4"};
    const uint64_t total = word_at(bytes, 8);
    if (total > bytes.size())
        return Error{"", fmt::format("truncated: the header declares {} bytes, the file has {}", total, bytes.size()), "byte 8"};
    if (total < header + chunk_header)
        return Error{"", fmt::format("the header declares {} bytes, fewer than a GLB header has", total), "byte 8"};
    for (uint64_t offset = header; offset < total;) {
        if (offset + chunk_header > total) return Error{"", "truncated chunk header", fmt::format("byte {}", offset)};
        const uint64_t end = offset + chunk_header + word_at(bytes, offset);
        if (end > total) return Error{"", "a chunk reaches beyond the file", fmt::format("byte {}", offset)};
        if (offset == header && word_at(bytes, offset + 4) != json_chunk)
            return Error{"", "the first chunk of the GLB is not JSON", "byte 16"};
        offset = end;
    }
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    return std::string_view(text + header + chunk_header, word_at(bytes, header));
}

} // namespace

Result<std::string_view> gltf_json_text(std::span<const uint8_t> bytes) {
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return all.starts_with("glTF") ? glb_json_text(bytes) : Result<std::string_view>(all);
}

std::span<const uint8_t> glb_binary(std::span<const uint8_t> bytes) {
    constexpr size_t header = 12, chunk_header = 8;
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!all.starts_with("glTF")) return {};
    const uint64_t chunk = header + chunk_header + word_at(bytes, header);
    if (chunk + chunk_header > word_at(bytes, 8) || word_at(bytes, chunk + 4) != binary_chunk) return {};
    return bytes.subspan(chunk + chunk_header, word_at(bytes, chunk));
}

std::vector<uint8_t> glb_bytes(std::string text, std::vector<uint8_t> binary) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4);
    const uint64_t total = 20 + text.size() + (binary.empty() ? 0 : 8 + binary.size());
    if (total > std::numeric_limits<uint32_t>::max()) return {};
    std::vector<uint8_t> bytes{'g', 'l', 'T', 'F'};
    bytes.reserve(total);
    append_word(bytes, 2);
    append_word(bytes, total);
    append_word(bytes, text.size());
    append_word(bytes, json_chunk);
    bytes.insert(bytes.end(), text.begin(), text.end());
    if (binary.empty()) return bytes;
    append_word(bytes, binary.size());
    append_word(bytes, binary_chunk);
    bytes.insert(bytes.end(), binary.begin(), binary.end());
    return bytes;
}

Result<json> check_gltf_json(std::string_view text, const std::filesystem::path& folder) {
    if (const size_t offset = too_deep_at(text); offset != std::string_view::npos)
        return Error{"", fmt::format("JSON nested deeper than {} levels", max_nesting), fmt::format("byte {}", offset)};
    json root;
    try {
        root = json::parse(text);
    } catch (const json::parse_error& e) {
        return Error{"", "not a glTF file: its JSON cannot be parsed", fmt::format("byte {}", e.byte)};
    } catch (const json::exception&) { return Error{"", "not a glTF file: a number in its JSON is out of range", ""}; }
    if (!root.is_object()) return Error{"", "not a glTF file: its JSON is not an object", ""};
    if (has_huge_object(root)) return Error{"", fmt::format("a JSON object of more than {} members", max_members), ""};
    if (const auto ok = check_version(root); !ok) return ok.error();
    if (const auto ok = check_required_extensions(root); !ok) return ok.error();
    if (const auto ok = check_uris(root, "buffers", folder); !ok) return ok.error();
    if (const auto ok = check_uris(root, "images", folder); !ok) return ok.error();
    return root;
}

} // namespace blush
