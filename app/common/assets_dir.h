// Locates the program's data files.
#pragma once

#include <filesystem>

namespace blush {

// $BLUSH_ASSETS if set; else ../share/blush/assets relative to the program (installed); else the source tree it was built from.
std::filesystem::path assets_dir();
// Weights of the denoiser: $BLUSH_WEIGHTS if set; else ../share/blush/weights relative to the program; else the build tree's
// `weights`.
std::filesystem::path weights_dir();
// The guide as HTML (packaging/make_guide): $BLUSH_GUIDE if set; else ../share/blush/guide relative to the program; else the build
// tree's `guide`.
std::filesystem::path guide_dir();

} // namespace blush
