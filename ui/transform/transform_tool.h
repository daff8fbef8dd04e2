// Modal transform (move, rotate, scale) by mouse and keys: its state and result. Pure: no window, no document.
#pragma once

#include "ui/transform/gizmo.h"
#include "ui/window/shortcuts.h"

#include <array>
#include <string>

namespace blush {

// Axis constraint of a transform.
struct AxisLock {
    int axis = -1;      // 0, 1, 2 for X, Y, Z; -1: free
    bool plane = false; // all axes except this one
    bool local = false; // axes of the selection instead of the world
    bool operator==(const AxisLock&) const = default;
};

// A transform of points in world space.
struct Motion {
    TransformMode mode = TransformMode::grab;
    Vec3d pivot{0, 0, 0};
    Vec3d by{0, 0, 0};                                            // grab: metres
    Vec3d axis{0, 0, 1};                                          // rotate: unit length
    double radians = 0;                                           // rotate: right-handed about the axis
    std::array<Vec3d, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; // scale: orthonormal
    Vec3d factors{1, 1, 1};                                       // scale: along the axes

    bool operator==(const Motion&) const = default;
    // The linear part: rotates or scales a direction.
    Vec3d direction(const Vec3d& v) const;
    Vec3d point(const Vec3d& p) const;
};

// Initial state of a transform.
struct TransformStart {
    TransformMode mode = TransformMode::grab;
    Vec3d pivot;
    std::array<Vec3d, 3> local_axes; // of the active object, orthonormal
    Projection projection;
    ImageRect image;
    ScreenPoint mouse;
    AxisLock lock = {};
    bool local_first = false; // the first press of X selects the local axis, the second the world axis
    float ring = 0;           // pixels: radius of the dragged ring; 0: none
};

class TransformTool {
public:
    explicit TransformTool(const TransformStart& start);

    enum class Answer { ignored, taken, confirmed, cancelled };
    // Keys. X, Y, Z: this axis; again: local axis; again: free; with Shift all but this axis. Digits, minus, point and Backspace:
    // the amount; Tab: the next of several amounts. G, R, S: another mode, restarted; R while rotating: trackball, and back. Enter or Space
    // confirms, Esc cancels.
    Answer press(const KeyPress& press);
    // `fine`: the movement since the last call counts a tenth. `snap`: amounts are rounded, to a tenth of the step if `fine`.
    void point_at(ScreenPoint mouse, bool fine, bool snap);

    Motion motion() const;
    // "Move along X: 2 m", the typed amount with a cursor.
    std::string text() const;
    TransformMode mode() const { return start_.mode; }
    // Rotation about the horizontal and vertical axis of the view at once, without constraints.
    bool is_trackball() const { return trackball_; }
    const AxisLock& lock() const { return lock_; }
    const Vec3d& pivot() const { return start_.pivot; }
    // Unit axes of the world or the selection, depending on the constraint.
    std::array<Vec3d, 3> axes() const;

private:
    static constexpr size_t max_typed = 12; // characters
    int amount_count() const;
    std::array<double, 3> amounts() const; // current number of amounts, in metres, degrees or as a factor
    std::array<double, 3> pointed_amounts() const;
    Vec3d pointed_at() const;
    double pointed_factor() const;
    Vec3d trackball_turn(double up_degrees, double right_degrees) const;
    double turn(ScreenPoint from, ScreenPoint to) const;
    Vec3d turn_axis() const;
    ScreenPoint centre() const;
    ViewRay ray(ScreenPoint p) const { return start_.projection.ray(start_.image.u(p.x), start_.image.v(p.y)); }
    double grab_step() const;
    bool is_typed() const;
    bool type(char c);
    void lock_to(int axis, bool plane);
    void switch_to(TransformMode mode);

    TransformStart start_;
    AxisLock lock_;
    ScreenPoint mouse_, at_; // mouse position, and the virtual position after slow fine moves
    double turned_ = 0;      // radians about turn_axis(), including full turns
    bool trackball_ = false;
    bool fine_ = false, snap_ = false;
    std::array<std::string, 3> typed_;
    size_t typing_ = 0;
};

} // namespace blush
