// UI state of value fields: requested clipboard actions, and colour picking.
#pragma once

#include "core/vec.h"

#include <optional>

namespace blush {

// A clipboard action for one value, from a key or its context menu.
enum class ValueAction { none, copy, copy_hex, copy_srgb, copy_all, paste, reset, pick };

struct ValueEditing {
    ValueAction requested = ValueAction::none; // for the field under the mouse
    int action_frame = -1;                     // the frame in which it is valid
    unsigned active_item = 0;                  // the item of the active gesture
    Vec3 before{1, 1, 1};                      // the colour when the picker was opened

    // The colour field that uses the eyedropper, and the picked scene-linear colour.
    unsigned dropper = 0;
    std::optional<Vec3> picked;
};

} // namespace blush
