// Where the program finds its own files.
#pragma once

#include <filesystem>

namespace blush {

// $BLUSH_ASSETS if set; else ../share/blush/assets beside the program, where installing puts them; else the source tree it was built from.
std::filesystem::path assets_dir();
// The denoiser's: $BLUSH_WEIGHTS if set; else ../share/blush/weights beside the program; else the build tree's `weights`.
std::filesystem::path weights_dir();

} // namespace blush
