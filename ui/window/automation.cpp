#include "ui/window/automation.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>

namespace blush {
namespace {

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

} // namespace

bool parse_size(const std::string& text, int& width, int& height) {
    int w = 0, h = 0;
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, w);
    if (first.ec != std::errc{} || first.ptr == end || *first.ptr != 'x') return false;
    const auto second = std::from_chars(first.ptr + 1, end, h);
    if (second.ec != std::errc{} || second.ptr != end || w <= 0 || h <= 0) return false;
    width = w;
    height = h;
    return true;
}

Automation automation_from_environment() {
    Automation a;
    a.probe_file = variable("BLUSH_UI_PROBE");
    a.stats_file = variable("BLUSH_UI_STATS");
    a.scale = std::clamp(std::strtof(variable("BLUSH_UI_SCALE").c_str(), nullptr), 0.f, 4.f);
    a.autosave_interval = std::clamp(std::strtod(variable("BLUSH_UI_AUTOSAVE").c_str(), nullptr), 0., 3600.);
    parse_size(variable("BLUSH_UI_SIZE"), a.width, a.height);
    return a;
}

} // namespace blush
