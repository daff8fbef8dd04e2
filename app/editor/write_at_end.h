// What the window writes when it ends.
#pragma once

#include "ui/window/frame_stats.h"
#include "ui/window/window_settings.h"

#include <filesystem>

namespace blush {

// Writes the settings, and the statistics unless their file is empty. A failure is a warning on stderr, because the window is already
// closed.
void write_at_end(const WindowSettings& settings, const FrameStats& stats, const std::filesystem::path& stats_file);

} // namespace blush
