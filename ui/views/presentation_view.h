// Presentation mode: the image with the panels of the talk alone, in large type, on the full screen.
#pragma once

#include <set>
#include <string>

namespace blush {

struct PresentationView {
    bool wanted = false;          // by command; the editor then begins or ends it
    bool on = false;              // the window shows it
    std::set<std::string> hidden; // ids of instruments that were open before it and are not of the lesson
};

constexpr int presentation_type = 150; // per cent of the text size of the window

} // namespace blush
