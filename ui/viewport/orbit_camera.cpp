#include "ui/viewport/orbit_camera.h"

#include "ui/transform/rotation.h"

#include <numbers>

namespace blush {
namespace {

constexpr double half_pi = std::numbers::pi / 2;
constexpr double nearest_to_pole = half_pi - 1e-3;

Vec3d forward(const View& view) { return rotate(view.rotation, {0, 0, -1}); }

// Rotation after a turn about world up and then about the view's right axis, clamped at the poles. A rolled view (from a scene's
// camera) keeps its roll.
Quat turned(const View& view, double yaw, double pitch) {
    const double elevation = std::asin(std::clamp(forward(view).y, -1.0, 1.0));
    const double limit = std::max(nearest_to_pole, std::abs(elevation));
    const double allowed = std::clamp(elevation + pitch, -limit, limit) - elevation;
    const Vec3d right = rotate(view.rotation, {1, 0, 0});
    return normalized(multiply(axis_angle({0, 1, 0}, yaw), multiply(axis_angle(right, allowed), view.rotation)));
}

} // namespace

Vec3d pivot(const View& view) { return to_double(view.position) + forward(view) * double(view.pivot_distance); }

View orbit(const View& view, double yaw, double pitch) {
    View next = view;
    next.rotation = turned(view, yaw, -pitch);
    next.position = to_float(pivot(view) - forward(next) * double(view.pivot_distance));
    return next;
}

View look_around(const View& view, double yaw, double pitch) {
    View next = view;
    next.rotation = turned(view, yaw, pitch);
    return next;
}

View pan(const View& view, double dx, double dy) {
    const double height = view.lens.orthographic ? 2.0 * view.lens.ymag : 2 * view.pivot_distance * std::tan(view.lens.yfov_radians / 2.0);
    return fly(view, {-dx * height, dy * height, 0});
}

View dolly(const View& view, double factor) {
    View next = view;
    if (view.lens.orthographic) {
        next.lens.ymag = float(std::clamp(view.lens.ymag * factor, 1e-6, 1e6));
        return next;
    }
    next.pivot_distance = float(std::clamp(view.pivot_distance * factor, 1e-4, 1e6));
    next.position = to_float(pivot(view) - forward(view) * double(next.pivot_distance));
    return next;
}

View fly(const View& view, const Vec3d& move) {
    View next = view;
    const Vec3d offset = rotate(view.rotation, {move.x, move.y, -move.z});
    next.position = to_float(to_double(view.position) + offset);
    return next;
}

} // namespace blush
