// Internal to io/gltf: writes a document and its external files.
#pragma once

#include "core/result.h"
#include "io/gltf/write/document.h"

#include <filesystem>
#include <string>
#include <vector>

namespace blush {

// The files of one save. The destructor removes new files unless write() has succeeded.
class SaveTransaction {
public:
    // For a scene that was read from `origin` and is saved as `target`.
    SaveTransaction(std::filesystem::path origin, std::filesystem::path target);
    ~SaveTransaction();
    SaveTransaction(const SaveTransaction&) = delete;
    SaveTransaction& operator=(const SaveTransaction&) = delete;

    // Copies the environment map, if there is one. An image without an existing file is written as EXR.
    Result<void> add_environment(Environment& environment);
    // Copies the file `name` (absolute, or relative to the original's folder) beside the target and sets `name` to the copy.
    Result<void> add_file(std::string& name);
    // Writes buffers, images and, last, the document. `original`: its text as read. Returns the text that was written.
    Result<std::string> write(GltfDocument& document, const std::string& original);

private:
    // Writes bytes into the target's folder, unless a file `wanted` has them already. Returns the name: `wanted` or a free
    // variant.
    Result<std::string> place(const std::string& wanted, std::span<const uint8_t> bytes);
    Result<std::string> place_copy(const std::string& relative);
    // The bytes of a buffer; empty for a placeholder of decompressed data.
    Result<std::vector<uint8_t>> buffer_bytes(GltfDocument& document, size_t index, const std::string& original) const;
    Result<void> write_beside(GltfDocument& document, const std::string& original);
    Result<std::vector<uint8_t>> binary_of(GltfDocument& document, const std::string& original);

    std::filesystem::path origin_, target_;
    std::filesystem::path from_, to_; // their folders
    bool same_folder_ = false;
    std::vector<std::filesystem::path> made_;
};

} // namespace blush
