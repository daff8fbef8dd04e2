// Positions of named widgets: written to a file for UI tests, which find the rectangle of "Light/Intensity" there; and that of the one
// widget that a lesson highlights.
#pragma once

#include "ui/window/layout.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace blush {

// State of the window other than widgets.
struct ProbeState {
    Region image; // the image's rectangle on the screen
    int width = 0, height = 0;
    int64_t samples = 0;
    bool complete = false;
    uint64_t revision = 0;   // number of edits that affect the image
    bool up_to_date = false; // the image shows the latest edit
    std::string toast;       // the newest toast
    std::string shown = {};  // shown_text(): raw, denoised, ...
    // What the window has taken up of the user's input, so that a test waits for it instead of sleeping: presses and releases of keys
    // and mouse buttons and turns of the wheel, as of the last frame after which nothing was left to settle.
    uint64_t inputs = 0;
    bool settled = false; // no frame is due now
    // Taken from ImGui by Probe::end_frame().
    int mouse_x = 0, mouse_y = 0;
    bool typing = false; // a text field has the keyboard
    bool operator==(const ProbeState&) const = default;
};

class Probe {
public:
    // With an empty path, nothing is recorded.
    explicit Probe(std::filesystem::path file = {}) : file_(std::move(file)) {}

    bool enabled() const { return !file_.empty(); }
    void begin_frame() {
        items_.clear();
        watched_region_.reset();
    }
    // The widget of this name is found even if nothing is recorded; empty: none.
    void watch(const std::string& name) { watched_ = name; }
    // Where the watched widget is in this frame; empty if it is not shown.
    const std::optional<Region>& watched_region() const { return watched_region_; }
    // Records the last ImGui item.
    void record_last_item(const std::string& name);
    // Records a draggable region that is not an ImGui item.
    void record(const std::string& name, const Region& region);
    // Writes the JSON file if its content has changed.
    void end_frame(const ProbeState& state);

private:
    struct Item {
        std::string name;
        Region region;
        bool operator==(const Item&) const = default;
    };
    std::filesystem::path file_;
    std::string watched_;
    std::optional<Region> watched_region_;
    std::vector<Item> items_, written_items_;
    ProbeState written_state_;
};

} // namespace blush
