#include "app/assets_dir.h"

#include <cstdlib>
#include <system_error>

namespace blush {

std::filesystem::path assets_dir() {
    if (const char* set = std::getenv("BLUSH_ASSETS"); set && *set) return set;
    std::error_code code;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", code);
    const std::filesystem::path installed = program.parent_path().parent_path() / "share" / "blush" / "assets";
    if (!code && std::filesystem::is_directory(installed, code)) return installed;
    return BLUSH_SOURCE_ASSETS;
}

} // namespace blush
