#include "app/commands/render/peak_memory.h"

#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

namespace blush {

double peak_memory_mb() {
    constexpr std::string_view key = "VmHWM:"; // kB
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(key)) return std::strtod(line.c_str() + key.size(), nullptr) / 1024;
    return 0;
}

} // namespace blush
