// The mouse and keys that move the view, and what a click means when nothing was moved.
#pragma once

#include "scene/scene.h"
#include "ui/gizmo.h"

#include <optional>

namespace blush {

// What the user asked of the viewport in this frame.
struct NavigationResult {
    std::optional<View> view;                          // moved there
    std::optional<ScreenPoint> select, toggle, toggle_shadow, focus, inspect; // clicked there: plain, with Shift, Alt+Shift, Ctrl, the right button
    double turned = 0;                                 // the surroundings were dragged to the right by this share of the image's height
    bool flying = false;                               // moves by itself while a key is held
    float brighter = 0;                                // stops of exposure
    bool begins_exposure = false;                      // of a new gesture
    double zoom = 1;                                   // times as large, about the mouse
    double shift_x = 0, shift_y = 0;                   // of the picture, pixels of the screen
};

class Navigation {
public:
    // `image` is where the picture lies, `hovered` whether the mouse is over it and `free` whether a press would be ours.
    NavigationResult update(const View& view, const ImageRect& image, bool hovered, bool free);
    // Between press and release.
    bool busy() const { return mode_ != Mode::none; }

private:
    enum class Mode { none, orbit, pan, dolly, look, expose, shift, turn_surroundings };
    void press();
    void drag(NavigationResult& result, const View& view, const ImageRect& image);
    void release(NavigationResult& result);
    void wheel(NavigationResult& result, const View& view);

    Mode mode_ = Mode::none;
    int button_ = 0;
    bool moved_ = false;     // further than a click's tremble
    bool may_click_ = false; // released without a move, it is a click
    ScreenPoint last_;
    double exposed_at_ = -1e9; // when the wheel last changed the exposure, seconds
};

} // namespace blush
