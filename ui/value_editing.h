// What the window knows of values being edited, beyond the document: what is asked of the value under the mouse, and colours being picked.
#pragma once

#include "core/vec.h"

#include <optional>

namespace blush {

// Asked of one value, by a key over its field or in its menu.
enum class ValueWish { none, copy, copy_hex, copy_srgb, copy_all, paste, reset, pick };

struct ValueEditing {
    ValueWish wish = ValueWish::none; // of the field under the mouse
    int wish_frame = -1;              // in which it holds
    unsigned in_hand = 0;             // the item whose gesture is under way
    Vec3 before{1, 1, 1};             // a colour, as it was when its picker was opened

    // The colour field that the eyedropper is for, and what it has picked: scene-linear.
    unsigned dropper = 0;
    std::optional<Vec3> picked;
};

} // namespace blush
