// Mouse and keyboard navigation of the view, and clicks in the viewport.
#pragma once

#include "scene/scene.h"
#include "ui/transform/gizmo.h"

#include <optional>

namespace blush {

// The user's input to the viewport in this frame.
struct NavigationResult {
    std::optional<View> view;                                                 // the new view
    std::optional<ScreenPoint> select, toggle, toggle_shadow, focus, inspect; // clicks: plain, with Shift, Alt+Shift, Ctrl, right button
    double turned = 0;               // drag of the environment to the right, as a fraction of the image's height
    bool flying = false;             // moves continuously while a key is held
    float brighter = 0;              // change of exposure in stops
    bool begins_exposure = false;    // this is a new gesture
    double zoom = 1;                 // factor, about the mouse position
    double shift_x = 0, shift_y = 0; // shift of the image in screen pixels
};

class Navigation {
public:
    // `image` is the image's rectangle, `hovered` whether the mouse is over it, `free` whether the viewport may use a press.
    NavigationResult update(const View& view, const ImageRect& image, bool hovered, bool free);
    // True between press and release.
    bool busy() const { return mode_ != Mode::none; }

private:
    enum class Mode { none, orbit, pan, dolly, look, expose, shift, turn_surroundings };
    void press();
    void drag(NavigationResult& result, const View& view, const ImageRect& image);
    void release(NavigationResult& result);
    void wheel(NavigationResult& result, const View& view);

    Mode mode_ = Mode::none;
    int button_ = 0;
    bool moved_ = false;     // further than a click allows
    bool may_click_ = false; // a release without movement is a click
    ScreenPoint last_;
    double exposed_at_ = -1e9; // time of the last exposure change by the wheel, seconds
};

} // namespace blush
