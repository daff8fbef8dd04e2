#include "app/common/output_folder.h"

#include "core/files.h"

#include <algorithm>
#include <unistd.h>

namespace blush {

std::filesystem::path home_folder() { return user_folder("HOME", ""); }

bool is_below(const std::filesystem::path& file, const std::filesystem::path& folder) {
    if (folder.empty()) return false;
    std::error_code error;
    const auto f = std::filesystem::weakly_canonical(file, error), g = std::filesystem::weakly_canonical(folder, error);
    return std::mismatch(g.begin(), g.end(), f.begin(), f.end()).first == g.end();
}

std::filesystem::path output_folder(const std::filesystem::path& chosen, const std::filesystem::path& scene_file,
                                    const std::filesystem::path& assets) {
    if (!chosen.empty()) return chosen;
    const std::filesystem::path beside = scene_file.parent_path();
    if (!beside.empty() && !is_below(scene_file, assets) && access(beside.c_str(), W_OK) == 0) return beside;
    const std::filesystem::path pictures = named_user_folder("XDG_PICTURES_DIR", "Pictures");
    return pictures.empty() ? beside : pictures;
}

} // namespace blush
