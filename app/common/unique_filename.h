// Unique names for new files.
#pragma once

#include "core/result.h"

#include <filesystem>
#include <string>

namespace blush {

// Returns FOLDER/STEM-0001EXTENSION with the first unused number; creates the folder if necessary.
// Errors: the folder cannot be created, no unused number.
Result<std::filesystem::path> unique_filename(const std::filesystem::path& folder, const std::string& stem, const std::string& extension);

} // namespace blush
