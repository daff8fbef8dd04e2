// Playing an animation in the window.
#pragma once

#include "scene/document.h"

namespace blush {

struct TimeView {
    bool playing = false;
    Gesture gesture = no_gesture; // that all of the playing is one step of
    bool dragged = false;         // the slider is held
};

} // namespace blush
