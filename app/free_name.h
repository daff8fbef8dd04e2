// A name for a new file in a folder of the user's.
#pragma once

#include "core/result.h"

#include <filesystem>
#include <string>

namespace blush {

// FOLDER/STEM-0001EXTENSION with the first number that is free; the folder is made if it is not there.
// Errors: the folder cannot be made, is full.
Result<std::filesystem::path> free_name(const std::filesystem::path& folder, const std::string& stem, const std::string& extension);

} // namespace blush
