// What the window knows of transforms of the selection: the gizmo that is shown, and the transform that is asked for or under way.
#pragma once

#include "ui/shortcuts.h"
#include "ui/transform_tool.h"

#include <optional>
#include <vector>

namespace blush {

struct TransformRequest {
    TransformMode mode = TransformMode::grab;
    AxisLock lock = {};
    bool by_drag = false; // of a handle: letting the button go confirms
    float ring = 0;       // pixels: radius of the ring that is dragged
};

struct TransformView {
    TransformMode gizmo = TransformMode::grab;
    bool local = false; // the gizmo's axes are the selection's, and X is the local one first
    std::optional<TransformRequest> wanted; // begun in the next frame of the picture
    bool active = false;
    std::vector<KeyPress> keys; // pressed since the last frame, for the transform

    // Keys are the transform's: it is under way, or about to be.
    bool takes_keys() const { return active || wanted; }
    // True for G, R and S, which it then asks for.
    bool begin(Command command) {
        if (command != Command::grab && command != Command::rotate && command != Command::scale) return false;
        wanted = {.mode = TransformMode(int(command) - int(Command::grab))};
        return true;
    }
};

} // namespace blush
