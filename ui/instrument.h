// An instrument: a panel that opens in a dock beside the image or in a window of its own.
#pragma once

#include "ui/panel_context.h"
#include "ui/window/dock.h"

#include <span>
#include <string>
#include <vector>

namespace blush {

struct Instrument {
    const char* id;      // key in window.json
    const char* title;   // of the tab or window
    const char* guide;   // its page of the guide, with anchor
    DockSide side;       // where it opens the first time
    float width, height; // of its window when it is torn off the first time, in font sizes
    bool remembered;     // reopened with the scene
    bool (*is_open)(const PanelContext& c);
    void (*set_open)(PanelContext& c, bool open);
    void (*draw)(PanelContext& c); // draws into the current ImGui window
};

// Null if none of them has this id.
const Instrument* find_instrument(std::span<const Instrument> instruments, const std::string& id);

// Without those that the presentation hides.
std::vector<Instrument> instruments_in_sight(std::span<const Instrument> instruments, const PanelContext& c);

// Ids of the open ones, in the order of the list.
std::vector<std::string> open_instruments(std::span<const Instrument> instruments, const PanelContext& c);

} // namespace blush
