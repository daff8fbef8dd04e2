// Internal to the import: the parsed file.
#pragma once

#include "core/result.h"

#include <nlohmann/json_fwd.hpp>
#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace blush {

struct GltfSource {
    std::filesystem::path file, folder;
    tinygltf::Model model; // images hold their encoded bytes; none if they are in a buffer view or missing
    std::shared_ptr<const std::vector<uint8_t>> whole_file = {}; // of a GLB whose binary chunk is read where it lies
    std::span<const uint8_t> binary = {};                        // the bytes of buffer 0 in it; empty if the model holds them
    std::string parser_notes;                                    // warnings of tinygltf
    std::shared_ptr<const std::string> text;                     // the JSON
    std::shared_ptr<const nlohmann::json> json;                  // parsed: extras and extensions are read from here

    // The bytes of a buffer of the model.
    std::span<const uint8_t> buffer_bytes(size_t index) const;
    // The number of bytes in all buffers.
    double bytes_in_buffers() const;
};

// Reads and checks the file and its external buffers and images. Opens no other files.
Result<GltfSource> load_gltf(const std::filesystem::path& file);

// For a document that is being saved: everything except triangles and pixels. Opens no files.
Result<GltfSource> load_gltf_records(const std::string& text);

} // namespace blush
