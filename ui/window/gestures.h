// Numbers the user's gestures, so that all edits of one drag become one undo step.
#pragma once

#include "scene/document/document.h"

namespace blush {

class GestureTracker {
public:
    // A widget was grabbed: edits from now on belong to a new gesture.
    Gesture begin() { return current_ = ++last_; }
    void end() { current_ = no_gesture; }
    // no_gesture outside of gestures: such an edit is an undo step of its own.
    Gesture current() const { return current_; }

private:
    Gesture last_ = no_gesture, current_ = no_gesture;
};

} // namespace blush
