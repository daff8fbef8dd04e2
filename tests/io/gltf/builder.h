// Builds small glTF files in memory: JSON and one buffer, written as .gltf with a data URI or as .glb. Does no checks, so that
// tests can create invalid files.
#pragma once

#include "io/gltf/read/import.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

namespace blush::test {

using Json = nlohmann::json;

// A temporary folder of this test.
class TempFolder {
public:
    TempFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "blush-test-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;
    ~TempFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    // How many files and folders are in it.
    size_t entries() const {
        return size_t(std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator()));
    }

private:
    std::filesystem::path path_;
};

// Always a new file: some file systems wait for the disk when an old one is overwritten, and some tests write thousands.
inline void write_bytes(const std::filesystem::path& file, std::string_view bytes) {
    std::filesystem::remove(file);
    std::ofstream(file, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

inline std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t word = 0;
        for (size_t k = 0; k < 3; ++k) word = word << 8 | (i + k < bytes.size() ? uint8_t(bytes[i + k]) : 0);
        for (size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[word >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

template <class T> constexpr int component_type = 0;
template <> inline constexpr int component_type<int8_t> = 5120;
template <> inline constexpr int component_type<uint8_t> = 5121;
template <> inline constexpr int component_type<int16_t> = 5122;
template <> inline constexpr int component_type<uint16_t> = 5123;
template <> inline constexpr int component_type<uint32_t> = 5125;
template <> inline constexpr int component_type<float> = 5126;

class GltfBuilder {
public:
    Json json = {{"asset", {{"version", "2.0"}}}};
    std::string buffer;
    Json further_buffers = Json::array(); // behind the one that `buffer` is

    // Appends an element to a top-level list and returns its index.
    int add(const char* list, Json value) {
        json[list].push_back(std::move(value));
        return int(json[list].size()) - 1;
    }
    int buffer_view(std::string_view bytes) {
        buffer.resize((buffer.size() + 3) / 4 * 4);
        const size_t offset = buffer.size();
        buffer += bytes;
        return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
    }
    // An accessor of its own buffer view; `type` is "SCALAR", "VEC2", ...
    template <class T> int accessor(const std::vector<T>& values, const std::string& type, bool normalized = false) {
        const size_t components = type == "SCALAR" ? 1 : size_t(type.back() - '0');
        const int view = buffer_view({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
        Json accessor = {{"bufferView", view}, {"componentType", component_type<T>}, {"count", values.size() / components}, {"type", type}};
        if (normalized) accessor["normalized"] = true;
        return add("accessors", accessor);
    }
    // A unit right triangle in the XY plane, facing +Z.
    int triangle_positions() { return accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3"); }
    // A mesh of one primitive, shown by a node of its own.
    int show(Json primitive) {
        const int mesh = add("meshes", {{"primitives", Json::array({std::move(primitive)})}});
        return add("nodes", {{"mesh", mesh}});
    }

    std::string gltf() const {
        Json whole = json;
        if (!buffer.empty() && !whole.contains("buffers"))
            whole["buffers"].push_back({{"byteLength", buffer.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer)}});
        for (const Json& further : further_buffers) whole["buffers"].push_back(further);
        return whole.dump();
    }
    std::string glb() const {
        Json whole = json;
        whole["buffers"] = Json::array({Json{{"byteLength", buffer.size()}}});
        for (const Json& further : further_buffers) whole["buffers"].push_back(further);
        std::string text = whole.dump(), binary = buffer;
        text.resize((text.size() + 3) / 4 * 4, ' ');
        binary.resize((binary.size() + 3) / 4 * 4);
        const auto word = [](size_t value) {
            const auto v = uint32_t(value);
            return std::string(reinterpret_cast<const char*>(&v), sizeof v);
        };
        return "glTF" + word(2) + word(28 + text.size() + binary.size()) + word(text.size()) + "JSON" + text + word(binary.size()) +
               std::string("BIN\0", 4) + binary;
    }
};

inline Result<ImportedScene> import_text(const TempFolder& folder, std::string_view text, const ImportOptions& options = {}) {
    const std::filesystem::path file = folder / (text.starts_with("glTF") ? "scene.glb" : "scene.gltf");
    write_bytes(file, text);
    return import_gltf(file, options);
}
inline Result<ImportedScene> import_built(const GltfBuilder& builder, const ImportOptions& options = {}) {
    const TempFolder folder;
    return import_text(folder, builder.gltf(), options);
}

// The text of the error, or "" if there is none.
template <class T> std::string error_text(const Result<T>& result) { return result ? "" : result.error().text(); }

// A diagnostic contains `part`.
inline bool reports(const ImportReport& report, std::string_view part) {
    for (const Diagnostic& d : report.diagnostics)
        if (d.what.find(part) != std::string::npos) return true;
    return false;
}

} // namespace blush::test
