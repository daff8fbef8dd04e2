// UI state of transforms of the selection: the displayed gizmo, and the requested or active transform.
#pragma once

#include "ui/transform/transform_tool.h"
#include "ui/window/shortcuts.h"

#include <optional>
#include <vector>

namespace blush {

struct TransformRequest {
    TransformMode mode = TransformMode::grab;
    AxisLock lock = {};
    bool by_drag = false; // of a handle: releasing the button confirms
    float ring = 0;       // pixels: radius of the dragged ring
};

struct TransformView {
    TransformMode gizmo = TransformMode::grab;
    bool local = false;                     // the gizmo has the axes of the selection, and X selects the local axis first
    std::optional<TransformRequest> wanted; // starts in the next frame of the viewport
    bool active = false;
    std::vector<KeyPress> keys; // pressed since the last frame, for the transform

    // True if keys belong to the transform: it is active or requested.
    bool takes_keys() const { return active || wanted; }
    // Requests a transform for G, R and S and returns true.
    bool begin(Command command) {
        if (command != Command::grab && command != Command::rotate && command != Command::scale) return false;
        wanted = {.mode = TransformMode(int(command) - int(Command::grab))};
        return true;
    }
};

} // namespace blush
