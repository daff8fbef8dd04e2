// Where the window writes pictures and charts when it does not ask.
#pragma once

#include <filesystem>

namespace blush {

// `chosen` if the user has chosen a folder. Else the folder of the scene; the folder of the user's pictures where that is `assets` (shipped
// scenes) or cannot be written. Never the working directory.
std::filesystem::path output_folder(const std::filesystem::path& chosen, const std::filesystem::path& scene_file, const std::filesystem::path& assets);

// $HOME; empty if it is not set.
std::filesystem::path home_folder();

// The file lies in the folder or below it.
bool is_below(const std::filesystem::path& file, const std::filesystem::path& folder);

} // namespace blush
