#include "io/gltf/write/save_files.h"

#include "core/files.h"
#include "io/gltf/read/json.h"
#include "io/gltf/read/uri.h"
#include "io/image/image_io.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <limits>

namespace blush {
namespace {

constexpr uint64_t max_file_bytes = std::numeric_limits<uint32_t>::max(); // 32-bit length field of GLB

bool has_file(const Json& object) {
    const Json& uri = child_or_null(object, "uri");
    return uri.is_string() && !is_data_uri(uri.get_ref<const std::string&>());
}
std::string uri_of(const Json& object) {
    const Json& uri = child_or_null(object, "uri");
    return uri.is_string() ? uri.get<std::string>() : std::string();
}

void append(std::vector<uint8_t>& bytes, std::span<const uint8_t> more) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    bytes.insert(bytes.end(), more.begin(), more.end());
}

// Every reference to a buffer, with its byte offset.
template <class Visit> void visit_buffer_ranges(Json& root, const Visit& visit) {
    const auto views = root.find("bufferViews");
    if (views == root.end()) return;
    for (Json& view : *views) {
        visit(view);
        const auto extensions = view.find("extensions");
        if (extensions == view.end() || !extensions->contains("EXT_meshopt_compression")) continue;
        visit((*extensions)["EXT_meshopt_compression"]);
    }
}

const char* mime_type(std::span<const uint8_t> bytes) { return !bytes.empty() && bytes[0] == 0xff ? "image/jpeg" : "image/png"; }

std::filesystem::path folder_of(const std::filesystem::path& file) {
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

} // namespace

SaveTransaction::SaveTransaction(std::filesystem::path origin, std::filesystem::path target)
    : origin_(std::move(origin)), target_(std::move(target)), from_(folder_of(origin_)), to_(folder_of(target_)) {
    std::error_code missing;
    same_folder_ = std::filesystem::equivalent(from_, to_, missing);
}

SaveTransaction::~SaveTransaction() {
    std::error_code ignored;
    for (const auto& file : made_) std::filesystem::remove(file, ignored);
}

Result<std::string> SaveTransaction::place(const std::string& wanted, std::span<const uint8_t> bytes) {
    const std::filesystem::path path(wanted);
    for (int number = 1; number < 10000; ++number) {
        std::filesystem::path name = path;
        if (number > 1) name.replace_filename(fmt::format("{}-{}{}", path.stem().string(), number, path.extension().string()));
        const std::filesystem::path file = to_ / name;
        std::error_code error;
        if (std::filesystem::exists(file, error)) {
            const auto there = read_file(file, max_file_bytes);
            if (there && std::ranges::equal(*there, bytes)) return name.string();
            continue;
        }
        std::filesystem::create_directories(file.parent_path(), error);
        if (const auto written = write_file(file, bytes); !written) return written.error();
        made_.push_back(file);
        return name.string();
    }
    return Error{(to_ / path).string(), "cannot save: no free file name", ""};
}

Result<std::string> SaveTransaction::place_copy(const std::string& relative) {
    const Result<std::filesystem::path> source = resolve_uri(from_, relative);
    if (!source) return source.error();
    const auto bytes = read_file(*source, max_file_bytes);
    if (!bytes) return bytes.error();
    return place(relative, *bytes);
}

Result<void> SaveTransaction::add_file(std::string& name) {
    const std::filesystem::path named(name);
    std::error_code missing;
    if (same_folder_ && resolve_uri(to_, name) && std::filesystem::exists(to_ / named, missing)) return {};
    const auto bytes = read_file(named.is_absolute() ? named : from_ / named, max_file_bytes);
    if (!bytes) return bytes.error();
    Result<std::string> placed = place(named.filename().string(), *bytes);
    if (!placed) return placed.error();
    name = *std::move(placed);
    return {};
}

Result<void> SaveTransaction::add_environment(Environment& environment) {
    if (!environment.image || add_file(environment.file)) return {};
    const Image& image = *environment.image;
    LayeredImage layers{image.width, image.height, {}, {}};
    constexpr const char* channels[] = {"R", "G", "B", "A"};
    for (int c = 0; c < image.channels; ++c) {
        std::vector<float> values(image.floats.size() / size_t(image.channels));
        for (size_t i = 0; i < values.size(); ++i) values[i] = image.floats[i * size_t(image.channels) + size_t(c)];
        layers.channels.push_back({channels[c], std::move(values)});
    }
    // Written to a temporary name first: the final name depends on existing files.
    const std::string name = target_.stem().string() + "-environment.exr";
    const std::filesystem::path temporary = to_ / ("." + name);
    if (const auto written = write_exr(temporary, layers); !written) return written.error();
    const auto encoded = read_file(temporary, max_file_bytes);
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    if (!encoded) return encoded.error();
    Result<std::string> placed = place(name, *encoded);
    if (!placed) return placed.error();
    environment.file = *std::move(placed);
    return {};
}

Result<std::vector<uint8_t>> SaveTransaction::buffer_bytes(GltfDocument& document, size_t index, const std::string& original) const {
    if (int(index) == document.added_buffer) return document.added;
    const Json& buffer = document.object("buffers", int(index));
    const std::string uri = uri_of(buffer);
    size_t length = 0;
    read_json(child_or_null(buffer, "byteLength"), length);
    std::vector<uint8_t> bytes;
    if (is_data_uri(uri)) {
        std::string type;
        if (!tinygltf::DecodeDataURI(&bytes, type, uri, length, false))
            return Error{"", "a data URI cannot be decoded", fmt::format("buffers[{}]", index)};
    } else if (!uri.empty()) {
        const auto file = resolve_uri(from_, percent_decoded(uri));
        if (!file) return file.error();
        auto read = read_file(*file, max_file_bytes);
        if (!read) return read.error();
        bytes = *std::move(read);
    } else {
        const auto file = read_file(origin_, max_file_bytes);
        if (!file) return file.error();
        const auto text = gltf_json_text(*file);
        if (!text || !text->starts_with(original)) return Error{origin_.string(), "has changed on disk since it was opened", ""};
        const auto binary = glb_binary(*file);
        if (index == 0) bytes.assign(binary.begin(), binary.end());
    }
    bytes.resize(std::min(bytes.size(), length));
    return bytes;
}

Result<void> SaveTransaction::write_beside(GltfDocument& document, const std::string& original) {
    for (const char* list : {"buffers", "images"}) {
        Json* const objects = document.find_list(list);
        for (size_t i = 0; objects && i < objects->size(); ++i) {
            Json& object = (*objects)[i];
            if (has_file(object) && !same_folder_) {
                const std::string before = percent_decoded(uri_of(object));
                const auto name = place_copy(before);
                if (!name) return name.error();
                if (*name != before) object["uri"] = percent_encoded(*name);
            } else if (list == std::string_view("buffers") && !object.contains("uri")) {
                const auto bytes = buffer_bytes(document, i, original);
                if (!bytes) return bytes.error();
                if (bytes->empty()) continue;
                const bool added = int(i) == document.added_buffer;
                const auto name = place(target_.stem().string() + (added ? "-added.bin" : ".bin"), *bytes);
                if (!name) return name.error();
                object["uri"] = percent_encoded(*name);
            }
        }
    }
    return {};
}

// Merges all buffers and images into one; buffers without bytes are kept behind it.
Result<std::vector<uint8_t>> SaveTransaction::binary_of(GltfDocument& document, const std::string& original) {
    std::vector<uint8_t> binary;
    std::vector<size_t> offsets;
    std::vector<int> places;
    Json buffers = Json::array();
    buffers.push_back(Json::object());
    const Json before = child_or_null(document.root, "buffers");
    for (size_t i = 0; i < before.size(); ++i) {
        const auto bytes = buffer_bytes(document, i, original);
        if (!bytes) return bytes.error();
        if (bytes->empty()) {
            places.push_back(int(buffers.size()));
            offsets.push_back(0);
            buffers.push_back(before[i]);
            continue;
        }
        append(binary, *bytes);
        places.push_back(0);
        offsets.push_back(binary.size() - bytes->size());
        if (buffers[0].empty()) buffers[0] = before[i];
    }
    visit_buffer_ranges(document.root, [&](Json& range) {
        size_t buffer = 0, offset = 0;
        if (!read_json(child_or_null(range, "buffer"), buffer) || buffer >= places.size()) return;
        read_json(child_or_null(range, "byteOffset"), offset);
        if (places[buffer] != int(buffer)) range["buffer"] = places[buffer];
        if (offsets[buffer] != 0) range["byteOffset"] = offset + offsets[buffer];
    });
    if (Json* images = document.find_list("images"))
        for (Json& image : *images) {
            if (!has_file(image)) continue;
            const auto file = resolve_uri(from_, percent_decoded(uri_of(image)));
            if (!file) return file.error();
            const auto bytes = read_file(*file, max_file_bytes);
            if (!bytes) return bytes.error();
            append(binary, *bytes);
            erase(image, "uri");
            image["bufferView"] = document.append(
                "bufferViews", {{"buffer", 0}, {"byteOffset", binary.size() - bytes->size()}, {"byteLength", bytes->size()}});
            image["mimeType"] = mime_type(*bytes);
        }
    if (binary.empty()) return binary;
    erase(buffers[0], "uri");
    buffers[0]["byteLength"] = binary.size();
    document.root["buffers"] = std::move(buffers);
    return binary;
}

Result<std::string> SaveTransaction::write(GltfDocument& document, const std::string& original) {
    const std::string extension = target_.extension().string();
    std::string text;
    Result<void> written;
    if (extension == ".glb" || extension == ".GLB") {
        Result<std::vector<uint8_t>> binary = binary_of(document, original);
        if (!binary) return binary.error();
        text = json_text(document.root);
        const std::vector<uint8_t> bytes = glb_bytes(text, *std::move(binary));
        if (bytes.empty()) return Error{target_.string(), "cannot save: too large for a .glb", ""};
        written = write_file(target_, bytes);
    } else if (extension == ".gltf" || extension == ".GLTF") {
        if (const auto ok = write_beside(document, original); !ok) return ok.error();
        // Keeps the indentation of the original.
        const bool lines = original.find('\n') != original.npos;
        text = document.root.dump(lines ? 2 : -1, ' ', false, Json::error_handler_t::replace) + (lines ? "\n" : "");
        written = write_file(target_, text);
    } else {
        return Error{target_.string(), "cannot save: the file extension must be .gltf or .glb", ""};
    }
    if (!written) return written.error();
    made_.clear();
    return text;
}

} // namespace blush
