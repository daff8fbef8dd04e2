#include "ui/viewport/projection.h"

#include "ui/transform/rotation.h"

namespace blush {

Projection::Projection(const View& view, double aspect)
    : eye_(to_double(view.position)), right_(normalize(rotate(view.rotation, {1, 0, 0}))), up_(normalize(rotate(view.rotation, {0, 1, 0}))),
      forward_(normalize(rotate(view.rotation, {0, 0, -1}))), aspect_(aspect), orthographic_(view.lens.orthographic),
      half_height_(view.lens.orthographic ? view.lens.ymag : std::tan(view.lens.yfov_radians / 2.0)) {}

std::optional<ImagePoint> Projection::project(const Vec3d& world) const {
    const Vec3d p = world - eye_;
    const double distance = dot(p, forward_);
    if (distance <= 1e-9) return {};
    const double half = orthographic_ ? half_height_ : half_height_ * distance;
    return ImagePoint{0.5 + 0.5 * dot(p, right_) / (half * aspect_), 0.5 - 0.5 * dot(p, up_) / half, distance};
}

ViewRay Projection::ray(double u, double v) const {
    const double x = (2 * u - 1) * half_height_ * aspect_, y = (1 - 2 * v) * half_height_;
    if (orthographic_) return {eye_ + right_ * x + up_ * y, forward_};
    return {eye_, normalize(forward_ + right_ * x + up_ * y)};
}

double Projection::height_at(double distance) const { return 2 * (orthographic_ ? half_height_ : half_height_ * distance); }

double Projection::axial_distance(double u, double v, double along_ray) const { return along_ray * dot(ray(u, v).direction, forward_); }

} // namespace blush
