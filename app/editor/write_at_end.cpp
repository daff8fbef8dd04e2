#include "app/editor/write_at_end.h"

#include <cstdio>
#include <fmt/format.h>

namespace blush {

void write_at_end(const WindowSettings& settings, const FrameStats& stats, const std::filesystem::path& stats_file) {
    const auto warn = [](const Result<void>& written) {
        if (!written) fmt::print(stderr, "blush: warning: {}\n", written.error().text());
    };
    if (const auto file = window_settings_file(); !file.empty()) warn(write_window_settings(file, settings));
    if (!stats_file.empty()) warn(stats.write(stats_file));
}

} // namespace blush
