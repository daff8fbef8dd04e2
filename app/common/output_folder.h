// Default folder for images and charts.
#pragma once

#include <filesystem>

namespace blush {

// `chosen` if the user has set a folder. Else the folder of the scene; or the user's pictures folder if the scene's folder is
// `assets` (shipped scenes) or not writable. Never the working directory.
std::filesystem::path output_folder(const std::filesystem::path& chosen, const std::filesystem::path& scene_file,
                                    const std::filesystem::path& assets);

// $HOME; empty if it is not set.
std::filesystem::path home_folder();

// True if the file is in the folder or a subfolder.
bool is_below(const std::filesystem::path& file, const std::filesystem::path& folder);

} // namespace blush
