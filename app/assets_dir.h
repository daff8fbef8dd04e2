// Where the files that ship with the program are.
#pragma once

#include <filesystem>

namespace blush {

// $BLUSH_ASSETS if set; else ../share/blush/assets beside the program, where installing puts them; else the source tree it was built from.
std::filesystem::path assets_dir();

} // namespace blush
