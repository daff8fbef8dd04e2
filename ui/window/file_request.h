// The purpose of a file dialog, and its answer.
#pragma once

#include "ui/window/file_listing.h"

#include <filesystem>

namespace blush {

// A file chosen by the user.
struct FileRequest {
    enum class Use { open, import_scene, environment, ies, snapshot_folder, convergence, save_scene, map, looks };
    Use use = Use::open;
    std::filesystem::path path;
};

// The title of the dialog, for example "Open a scene".
const char* title_of(FileRequest::Use use);
// The accepted file types; empty for a folder.
const ExtensionFilter& filter_of(FileRequest::Use use);

} // namespace blush
