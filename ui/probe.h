// Where the window's widgets are, by name, for automation: a test that drags "Light/Intensity" asks here where that is.
#pragma once

#include "ui/layout.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace blush {

// What the window shows besides its widgets.
struct ProbeState {
    Region image; // of the picture on the screen
    int width = 0, height = 0;
    int64_t samples = 0;
    bool complete = false;
    uint64_t revision = 0;   // counts the edits that reach the picture
    bool up_to_date = false; // the picture answers the latest edit
    std::string toast;       // the newest
    std::string look = {};   // raw, denoised, ...: shown_text()
    bool operator==(const ProbeState&) const = default;
};

class Probe {
public:
    // With an empty path nothing is recorded.
    explicit Probe(std::filesystem::path file = {}) : file_(std::move(file)) {}

    bool enabled() const { return !file_.empty(); }
    void begin_frame() { items_.clear(); }
    // The widget that ImGui drew last.
    void record_last_item(const std::string& name);
    // What can be dragged without being a widget.
    void record(const std::string& name, const Region& region);
    // Writes a JSON file if anything differs from what it holds.
    void end_frame(const ProbeState& state);

private:
    struct Item {
        std::string name;
        Region region;
        bool operator==(const Item&) const = default;
    };
    std::filesystem::path file_;
    std::vector<Item> items_, written_items_;
    ProbeState written_state_;
};

} // namespace blush
