#include "ui/window/time_text.h"

#include <cstdint>
#include <fmt/format.h>

namespace blush {

std::string elapsed_text(double seconds) {
    if (seconds < 60) return fmt::format("{:.1f} s", seconds);
    if (!(seconds < 1e12)) return "-";
    const auto whole = int64_t(seconds);
    if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02} h", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string guessed_time_text(double seconds) {
    const auto text = [](double value, const char* unit) { return fmt::format("{:.{}f} {}", value, value < 9.95 ? 1 : 0, unit); };
    if (seconds < 99.5) return text(seconds, "s");
    if (seconds < 99.5 * 60) return text(seconds / 60, "min");
    if (seconds < 47.5 * 3600) return text(seconds / 3600, "h");
    if (seconds < 1000 * 86400.0) return text(seconds / 86400, "days");
    return "years";
}

} // namespace blush
