// The instruments: panels that measure, compare or analyse the picture, or list its lights and edits. They open in the docks
// beside it.
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
    DockSide side;       // where it opens the first time
    float width, height; // of its window when it is torn off the first time, in font sizes
    bool remembered;     // reopened with the scene
    bool (*is_open)(const PanelContext& c);
    void (*set_open)(PanelContext& c, bool open);
    void (*draw)(PanelContext& c); // draws into the current ImGui window
};

std::span<const Instrument> instruments();
// Null if the id is unknown.
const Instrument* find_instrument(const std::string& id);

// Opens it; or brings its tab to the front if it is hidden; or closes it if it is visible.
void toggle_instrument(PanelContext& c, const std::string& id);

// Ids of the open instruments, in the order of the table.
std::vector<std::string> open_instruments(const PanelContext& c);

// Opens the instruments that were open when the scene was last closed.
void recall_instruments(PanelContext c, const std::string& file);

} // namespace blush
