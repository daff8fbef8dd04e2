#include "app/common/assets_dir.h"

#include <cstdlib>
#include <system_error>

namespace blush {
namespace {

// The value of `variable` if set; else ../share/blush/NAME relative to the program (installed); else `built`.
std::filesystem::path find_dir(const char* variable, const char* name, const char* built) {
    if (const char* set = std::getenv(variable); set && *set) return set;
    std::error_code code;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", code);
    const std::filesystem::path installed = program.parent_path().parent_path() / "share" / "blush" / name;
    if (!code && std::filesystem::is_directory(installed, code)) return installed;
    return built;
}

} // namespace

std::filesystem::path assets_dir() { return find_dir("BLUSH_ASSETS", "assets", BLUSH_SOURCE_ASSETS); }
std::filesystem::path weights_dir() { return find_dir("BLUSH_WEIGHTS", "weights", BLUSH_BUILT_WEIGHTS); }
std::filesystem::path guide_dir() { return find_dir("BLUSH_GUIDE", "guide", BLUSH_BUILT_GUIDE); }

} // namespace blush
