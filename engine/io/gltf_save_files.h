// Internal to gltf_*.cpp: a document and the files beside it onto the disk.
#pragma once

#include "core/result.h"
#include "io/gltf_document.h"

#include <filesystem>
#include <string>
#include <vector>

namespace blush {

// The files of one save. Those it has made are gone with it unless write() has succeeded.
class SavedFiles {
public:
    // Of the scene that was read from `origin`, saved as `target`.
    SavedFiles(std::filesystem::path origin, std::filesystem::path target);
    ~SavedFiles();
    SavedFiles(const SavedFiles&) = delete;
    SavedFiles& operator=(const SavedFiles&) = delete;

    // The same for an environment map, if there is an image. One that came from no file, or from one that is gone, is written as EXR.
    Result<void> add_environment(Environment& environment);
    // Puts the file that `name` stands for (absolute, or relative to the original's folder) beside the target, and names it there.
    Result<void> add_file(std::string& name);
    // Buffers, images and, last, the document. `original` is its text as it was read. Returns the text that was written.
    Result<std::string> write(GltfDocument& document, const std::string& original);

private:
    // A name in the target's folder, `wanted` or one like it, under which the folder has these bytes.
    Result<std::string> place(const std::string& wanted, std::span<const uint8_t> bytes);
    Result<std::string> place_copy(const std::string& relative);
    // The bytes of a buffer; none if it has none to copy (a placeholder for decompressed data).
    Result<std::vector<uint8_t>> buffer_bytes(GltfDocument& document, size_t index, const std::string& original) const;
    Result<void> write_beside(GltfDocument& document, const std::string& original);
    Result<std::vector<uint8_t>> binary_of(GltfDocument& document, const std::string& original);

    std::filesystem::path origin_, target_;
    std::filesystem::path from_, to_; // their folders
    bool same_folder_ = false;
    std::vector<std::filesystem::path> made_;
};

} // namespace blush
