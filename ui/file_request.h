// What a file is wanted for, and the answer of a file dialog.
#pragma once

#include "ui/file_listing.h"

#include <filesystem>

namespace blush {

// A file that the user has chosen.
struct FileRequest {
    enum class Use { open, import_scene, environment, ies, snapshot_folder, convergence, save_scene, map };
    Use use = Use::open;
    std::filesystem::path path;
};

// "Open a scene", a dialog's title.
const char* title_of(FileRequest::Use use);
// The files that fit; empty for a folder.
const ExtensionFilter& filter_of(FileRequest::Use use);

} // namespace blush
