// What tests ask of the window through the environment; none of it is needed for work.
#pragma once

#include <filesystem>
#include <string>

namespace blush {

struct Automation {
    std::filesystem::path probe_file; // BLUSH_UI_PROBE: where the widgets are, rewritten as they change (probe.h)
    std::filesystem::path stats_file; // BLUSH_UI_STATS: frame times and latencies, written at the end (frame_stats.h)
    float scale = 0;                  // BLUSH_UI_SCALE: of fonts and spacing in place of the display's
    double autosave_interval = 0;     // BLUSH_UI_AUTOSAVE: seconds in place of the usual ones
    int width = 0, height = 0;        // BLUSH_UI_SIZE=WxH: of the window in place of the remembered one
};

Automation automation_from_environment();
// "800x600"; false and nothing changed for anything else.
bool parse_size(const std::string& text, int& width, int& height);

} // namespace blush
