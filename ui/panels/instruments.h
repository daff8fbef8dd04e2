// The instruments: panels that measure, compare or take apart the picture, or list what makes it. They open into the docks beside it.
#pragma once

#include "ui/dock.h"
#include "ui/panels/context.h"

#include <span>
#include <string>
#include <vector>

namespace blush {

struct Instrument {
    const char* id;      // in window.json
    const char* title;   // of its tab or window
    DockSide side;       // where it opens at first
    float width, height; // of its window when it is torn off at first, in font sizes
    bool remembered;     // open again with the scene that it was open with
    bool (*is_open)(const PanelContext& c);
    void (*set_open)(PanelContext& c, bool open);
    void (*draw)(PanelContext& c); // into the current ImGui window
};

std::span<const Instrument> instruments();
// Null for an id that none has.
const Instrument* find_instrument(const std::string& id);

// Opens it, or brings it to the front of its dock if another tab hides it, or closes it if it is in sight.
void toggle_instrument(PanelContext& c, const std::string& id);

// Ids of those that are open, in the order of the table.
std::vector<std::string> open_instruments(const PanelContext& c);

// Opens those that were open with a scene file when its window was closed.
void recall_instruments(PanelContext c, const std::string& file);

} // namespace blush
