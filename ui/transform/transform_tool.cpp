#include "ui/transform/transform_tool.h"

#include "ui/transform/rotation.h"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <numbers>

namespace blush {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double min_reach = 8; // minimum distance from the pivot for scaling, pixels
constexpr double max_amount = 1e9;
constexpr double degrees_step = 5, factor_step = 0.1;
constexpr double trackball_degrees = 0.01 / degree; // per pixel, as in Blender
constexpr std::array<Vec3d, 3> world_axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr const char* axis_names[] = {"X", "Y", "Z"};

double wrapped(double radians) { return std::remainder(radians, 2 * std::numbers::pi); }

// Angle on the screen, counter-clockwise from the right.
double angle_of(ScreenPoint p, ScreenPoint centre) { return std::atan2(centre.y - p.y, p.x - centre.x); }

double rounded_to(double value, double step) { return std::round(value / step) * step; }

// The character of a key for typed amounts; 0: none.
char character_of(const KeyPress& press) {
    if (press.typed != 0 && press.typed < 128) return char(std::tolower(int(press.typed)));
    if (press.key >= key::pad_zero && press.key < key::pad_zero + 10) return char('0' + press.key - key::pad_zero);
    if (press.key == key::pad_minus) return '-';
    if (press.key == key::pad_point) return '.';
    return press.key > key::space && press.key < 128 ? char(std::tolower(press.key)) : char(0);
}

// A minus or a point alone is an incomplete number.
double number_in(const std::string& text, double empty) {
    const bool negative = !text.empty() && text[0] == '-';
    const std::string digits = text.substr(negative ? 1 : 0);
    const double magnitude = digits.find_first_of("0123456789") == std::string::npos ? empty : std::strtod(digits.c_str(), nullptr);
    return std::min(magnitude, max_amount) * (negative ? -1 : 1);
}

// The free axis, and the one after it.
std::array<int, 2> others(int axis) { return {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2}; }

} // namespace

Vec3d Motion::direction(const Vec3d& v) const {
    if (mode == TransformMode::rotate)
        return v * std::cos(radians) + cross(axis, v) * std::sin(radians) + axis * (dot(axis, v) * (1 - std::cos(radians)));
    if (mode == TransformMode::grab) return v;
    return axes[0] * (factors.x * dot(axes[0], v)) + axes[1] * (factors.y * dot(axes[1], v)) + axes[2] * (factors.z * dot(axes[2], v));
}

Vec3d Motion::point(const Vec3d& p) const { return pivot + by + direction(p - pivot); }

TransformTool::TransformTool(const TransformStart& start) : start_(start), lock_(start.lock), mouse_(start.mouse), at_(start.mouse) {}

std::array<Vec3d, 3> TransformTool::axes() const { return lock_.local ? start_.local_axes : world_axes; }

int TransformTool::amount_count() const {
    if (trackball_) return 2;
    if (start_.mode != TransformMode::grab) return 1;
    return lock_.axis < 0 ? 3 : lock_.plane ? 2 : 1;
}

bool TransformTool::is_typed() const { return !typed_[0].empty() || !typed_[1].empty() || !typed_[2].empty(); }

ScreenPoint TransformTool::centre() const {
    const auto seen = start_.projection.project(start_.pivot);
    const ImageRect& r = start_.image;
    return seen ? r.at(*seen) : ScreenPoint{r.x + r.width / 2, r.y + r.height / 2};
}

Vec3d TransformTool::turn_axis() const { return lock_.axis < 0 ? -start_.projection.forward() : axes()[size_t(lock_.axis)]; }

// Axis times radians. What faces the viewer follows the mouse.
Vec3d TransformTool::trackball_turn(double up_degrees, double right_degrees) const {
    const Projection& p = start_.projection;
    return (p.up() * right_degrees - p.right() * up_degrees) * degree;
}

double TransformTool::turn(ScreenPoint from, ScreenPoint to) const {
    const Vec3d axis = turn_axis();
    if (start_.ring > 0) {
        const auto a = ring_angle(ray(from), start_.pivot, axis), b = ring_angle(ray(to), start_.pivot, axis);
        if (a && b) return wrapped(*b - *a);
        return edge_on_ring_angle(start_.projection, start_.pivot, axis, from, to, start_.ring);
    }
    const ScreenPoint c = centre();
    const double turned = wrapped(angle_of(to, c) - angle_of(from, c));
    return dot(axis, ray(c).direction) > 0 ? -turned : turned;
}

void TransformTool::point_at(ScreenPoint mouse, bool fine, bool snap) {
    const float share = fine ? 0.1f : 1.f;
    const ScreenPoint before = at_;
    at_ = {at_.x + (mouse.x - mouse_.x) * share, at_.y + (mouse.y - mouse_.y) * share};
    mouse_ = mouse;
    turned_ += turn(before, at_);
    fine_ = fine;
    snap_ = snap;
}

double TransformTool::grab_step() const {
    const double distance = std::max(dot(start_.pivot - start_.projection.eye(), start_.projection.forward()), 1e-6);
    return std::pow(10, std::floor(std::log10(start_.projection.height_at(distance) / 4)));
}

Vec3d TransformTool::pointed_at() const {
    const ViewRay from = ray(start_.mouse), to = ray(at_);
    const std::array<Vec3d, 3> a = axes();
    if (lock_.axis >= 0 && !lock_.plane) {
        const Vec3d axis = a[size_t(lock_.axis)];
        const auto s = nearest_on_axis(from, start_.pivot, axis), t = nearest_on_axis(to, start_.pivot, axis);
        return s && t ? axis * (*t - *s) : Vec3d{0, 0, 0};
    }
    const Vec3d normal = lock_.axis < 0 ? start_.projection.forward() : a[size_t(lock_.axis)];
    const auto s = meet_plane(from, start_.pivot, normal), t = meet_plane(to, start_.pivot, normal);
    return s && t ? *t - *s : Vec3d{0, 0, 0};
}

double TransformTool::pointed_factor() const {
    const ScreenPoint c = centre();
    const double sx = start_.mouse.x - c.x, sy = start_.mouse.y - c.y, x = at_.x - c.x, y = at_.y - c.y;
    const double reach = std::hypot(sx, sy);
    if (reach < min_reach) return 1 + (x - sx) / 100; // started on the pivot: dragging to the right enlarges
    return std::hypot(x, y) / reach * (x * sx + y * sy < 0 ? -1 : 1);
}

std::array<double, 3> TransformTool::pointed_amounts() const {
    const double finer = fine_ ? 0.1 : 1;
    const auto snapped = [&](double value, double step) { return snap_ ? rounded_to(value, step * finer) : value; };
    if (trackball_)
        return {snapped((start_.mouse.y - at_.y) * trackball_degrees, degrees_step),
                snapped((at_.x - start_.mouse.x) * trackball_degrees, degrees_step), 0};
    if (start_.mode == TransformMode::rotate) return {snapped(turned_ / degree, degrees_step), 0, 0};
    if (start_.mode == TransformMode::scale) return {snapped(pointed_factor(), factor_step), 0, 0};
    const Vec3d by = pointed_at();
    const std::array<Vec3d, 3> a = axes();
    const double step = grab_step();
    const auto along = [&](int axis) { return snapped(dot(by, a[size_t(axis)]), step); };
    if (lock_.axis < 0) return {along(0), along(1), along(2)};
    if (!lock_.plane) return {along(lock_.axis), 0, 0};
    const auto [first, second] = others(lock_.axis);
    return {along(first), along(second), 0};
}

std::array<double, 3> TransformTool::amounts() const {
    if (!is_typed()) return pointed_amounts();
    const double empty = start_.mode == TransformMode::scale ? 1 : 0;
    return {number_in(typed_[0], empty), number_in(typed_[1], empty), number_in(typed_[2], empty)};
}

Motion TransformTool::motion() const {
    Motion m{.mode = start_.mode, .pivot = start_.pivot, .axes = axes()};
    const std::array<double, 3> amount = amounts();
    switch (start_.mode) {
    case TransformMode::rotate:
        if (trackball_) {
            const Vec3d turn = trackball_turn(amount[0], amount[1]);
            m.radians = length(turn);
            m.axis = m.radians > 0 ? turn / m.radians : turn_axis();
            break;
        }
        m.axis = turn_axis();
        m.radians = amount[0] * degree;
        break;
    case TransformMode::scale: {
        double* const factors[] = {&m.factors.x, &m.factors.y, &m.factors.z};
        for (int i = 0; i < 3; ++i)
            if (lock_.axis < 0 || (i == lock_.axis) != lock_.plane) *factors[i] = amount[0];
        break;
    }
    case TransformMode::grab:
        if (lock_.axis < 0)
            m.by = m.axes[0] * amount[0] + m.axes[1] * amount[1] + m.axes[2] * amount[2];
        else if (!lock_.plane)
            m.by = m.axes[size_t(lock_.axis)] * amount[0];
        else
            m.by = m.axes[size_t(others(lock_.axis)[0])] * amount[0] + m.axes[size_t(others(lock_.axis)[1])] * amount[1];
        break;
    }
    return m;
}

std::string TransformTool::text() const {
    static constexpr const char* verbs[] = {"Move", "Rotate", "Scale"};
    const TransformMode mode = start_.mode;
    std::string text = trackball_ ? "Rotate (trackball)" : verbs[size_t(mode)];
    if (lock_.axis >= 0) {
        const char* axis = axis_names[lock_.axis];
        const auto [first, second] = others(lock_.axis);
        text += lock_.plane ? fmt::format(" in {}{}", axis_names[first], axis_names[second])
                            : fmt::format(" {} {}", mode == TransformMode::rotate ? "about" : "along", axis);
        if (lock_.local) text += " (local)";
    }
    text += ":";
    const std::array<double, 3> amount = amounts();
    for (int i = 0; i < amount_count(); ++i) {
        const int axis = amount_count() == 3 ? i : others(std::max(lock_.axis, 0))[size_t(i)];
        const std::string name = trackball_ ? (i == 0 ? " up" : " right") : amount_count() > 1 ? fmt::format(" {}", axis_names[axis]) : "";
        const std::string& typed = typed_[size_t(i)];
        const bool here = is_typed() && size_t(i) == typing_;
        text += fmt::format("{} {}", name, here ? typed + "|" : fmt::format("{:.4g}", amount[size_t(i)] + 0.0));
    }
    return text + (mode == TransformMode::grab ? " m" : mode == TransformMode::rotate ? "°" : "");
}

void TransformTool::switch_to(TransformMode mode) {
    start_.mode = mode;
    start_.ring = 0;
    trackball_ = false;
    lock_ = {};
    typed_ = {};
    typing_ = 0;
    turned_ = turn(start_.mouse, at_);
}

// Pressing the same key again: the other kind of axes, then no lock.
void TransformTool::lock_to(int axis, bool plane) {
    const bool in_plane = plane && start_.mode != TransformMode::rotate;
    const AxisLock first{axis, in_plane, start_.local_first}, second{axis, in_plane, !start_.local_first};
    lock_ = lock_ == first ? second : lock_ == second ? AxisLock{} : first;
    if (typing_ >= size_t(amount_count())) {
        typed_ = {};
        typing_ = 0;
    }
    start_.ring = 0;
    turned_ = turn(start_.mouse, at_);
}

bool TransformTool::type(char c) {
    std::string& text = typed_[typing_];
    if (c == '-') {
        if (!text.empty() && text[0] == '-')
            text.erase(0, 1);
        else
            text.insert(0, "-");
        return true;
    }
    const char digit = c == ',' ? '.' : c;
    if (digit != '.' && (digit < '0' || digit > '9')) return false;
    const bool second_point = digit == '.' && text.find('.') != std::string::npos;
    if (!second_point && text.size() < max_typed) text += digit;
    return true;
}

TransformTool::Answer TransformTool::press(const KeyPress& press) {
    switch (press.key) {
    case key::escape: return Answer::cancelled;
    case key::enter:
    case key::pad_enter:
    case key::space: return Answer::confirmed;
    case key::tab: typing_ = (typing_ + 1) % size_t(amount_count()); return Answer::taken;
    case key::backspace:
        if (!typed_[typing_].empty()) typed_[typing_].pop_back();
        return Answer::taken;
    default: break;
    }
    if (press.alt) return Answer::ignored;
    switch (const char c = character_of(press)) {
    case 'x':
    case 'y':
    case 'z':
        if (!press.ctrl && !trackball_) lock_to(c - 'x', press.shift);
        return Answer::taken;
    case 'g': switch_to(TransformMode::grab); return Answer::taken;
    case 'r': {
        const bool again = start_.mode == TransformMode::rotate && !trackball_;
        switch_to(TransformMode::rotate);
        trackball_ = again;
        return Answer::taken;
    }
    case 's': switch_to(TransformMode::scale); return Answer::taken;
    default: return type(c) ? Answer::taken : Answer::ignored;
    }
}

} // namespace blush
