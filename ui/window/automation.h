// Environment variables for tests; not needed for normal use.
#pragma once

#include <filesystem>
#include <string>

namespace blush {

struct Automation {
    std::filesystem::path probe_file; // BLUSH_UI_PROBE: positions of the widgets, rewritten when they change (probe.h)
    std::filesystem::path stats_file; // BLUSH_UI_STATS: frame times and latencies, written at exit (frame_stats.h)
    float scale = 0;                  // BLUSH_UI_SCALE: scale of fonts and spacing; overrides that of the display
    double autosave_interval = 0;     // BLUSH_UI_AUTOSAVE: seconds; overrides the default interval
    int width = 0, height = 0;        // BLUSH_UI_SIZE=WxH: size of the window; overrides the saved one
};

Automation automation_from_environment();
// Parses "800x600". Returns false and changes nothing if the text is invalid.
bool parse_size(const std::string& text, int& width, int& height);

} // namespace blush
