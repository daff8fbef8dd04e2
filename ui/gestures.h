// Numbers the user's gestures, so that all edits of one drag become one step of the history.
#pragma once

#include "scene/document.h"

namespace blush {

class GestureTracker {
public:
    // A widget was grabbed: from now on edits belong to a new gesture.
    Gesture begin() { return current_ = ++last_; }
    void end() { current_ = no_gesture; }
    // no_gesture between gestures: an edit made then is a step of its own.
    Gesture current() const { return current_; }

private:
    Gesture last_ = no_gesture, current_ = no_gesture;
};

} // namespace blush
