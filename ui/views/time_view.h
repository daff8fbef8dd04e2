// UI state of animation playback.
#pragma once

#include "scene/document/document.h"

namespace blush {

struct TimeView {
    bool playing = false;
    Gesture gesture = no_gesture; // all of one playback is one undo step
    bool dragged = false;         // the slider is held
};

} // namespace blush
