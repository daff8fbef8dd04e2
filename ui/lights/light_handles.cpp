#include "ui/lights/light_handles.h"

#include "scene/affine.h"
#include "ui/lights/light_tools.h"
#include "ui/transform/rotation.h"

#include <numbers>

namespace blush {
namespace {

constexpr float min_size = 1e-4f, min_spread = 0.002f;
constexpr double dial_start = 1.6, dial_decade = 1.1, dial_finest = 0.05 * std::numbers::pi / 180; // ems, ems, radians

// Right and down on the screen, where axis handles are rare.
Vec3d screen_diagonal(const Projection& projection) { return normalize(projection.right() - projection.up()); }

Vec3d axis_of(const LightInView& sight) { return rotate(sight.rotation, {0, 0, -1}); }

// The silhouette edge of the cone, as seen by the viewer.
Vec3d silhouette(const Vec3d& axis, const Projection& projection) {
    const Vec3d side = cross(axis, projection.forward());
    return length(side) > 1e-6 ? normalize(side) : any_perpendicular(axis);
}

// True if the view direction is closer to the axis than to its normal plane.
bool seen_end_on(const Vec3d& axis, const Projection& projection) { return std::abs(dot(axis, projection.forward())) > 0.7; }

// Metres of a drag along an axis of the light, or along the screen's diagonal.
double dragged_along(const Vec3d& axis, const Vec3d& origin, const ViewRay& from, const ViewRay& to) {
    const auto a = nearest_on_axis(from, origin, axis), b = nearest_on_axis(to, origin, axis);
    return a && b ? *b - *a : 0;
}
double dragged_along_screen(const Projection& projection, const Vec3d& origin, const ViewRay& from, const ViewRay& to) {
    const auto a = meet_plane(from, origin, projection.forward()), b = meet_plane(to, origin, projection.forward());
    return a && b ? dot(*b - *a, screen_diagonal(projection)) : 0;
}

// True if the radius is dragged in the screen plane; for a disk, it is dragged in the plane of the disk.
bool is_ball(Light::Kind kind) { return kind != Light::Kind::disk; }

Vec3d cone_point(const LightInView& sight, const Projection& projection, double angle, double side) {
    const Vec3d axis = axis_of(sight);
    return sight.world_from_node.t + (axis * std::cos(angle) + silhouette(axis, projection) * (side * std::sin(angle))) * sight.reach;
}

Light with_radius(const LightInView& start, const Projection& projection, const ViewRay& from, const ViewRay& to) {
    Light light = start.light;
    const Affined& m = start.world_from_node;
    const double scale = length(m.x);
    if (!(scale > 0)) return light;
    const double metres = is_ball(light.kind) ? dragged_along_screen(projection, m.t, from, to) : dragged_along(m.x / scale, m.t, from, to);
    const bool may_vanish = !is_per_area(light.kind);
    light.radius = std::max(light.radius + float(metres / scale), may_vanish ? 0.f : min_size);
    return light;
}

float with_side(float side, const Vec3d& axis, const Vec3d& origin, const ViewRay& from, const ViewRay& to) {
    const double scale = length(axis);
    if (!(scale > 0)) return side;
    return std::max(side + 2 * float(dragged_along(axis / scale, origin, from, to) / scale), min_size);
}

Light with_cone(const LightInView& start, Handle handle, const Projection& projection, const ViewRay& from, const ViewRay& to) {
    Light light = start.light;
    const Vec3d apex = start.world_from_node.t, axis = axis_of(start);
    const auto a = cone_angle_under(from, apex, axis, projection, start.reach),
               b = cone_angle_under(to, apex, axis, projection, start.reach);
    if (!a || !b) return light;
    const auto turned = [&](float angle) { return std::clamp(angle + float(*b - *a), 0.f, float(std::numbers::pi / 2)); };
    if (handle == Handle::spread) {
        light.spread_radians = std::max(2 * turned(light.spread_radians / 2), min_spread);
        return light;
    }
    if (handle == Handle::outer_cone) {
        light.outer_cone_radians = std::max(turned(light.outer_cone_radians), 0.01f);
        light.inner_cone_radians = std::min(light.inner_cone_radians, light.outer_cone_radians);
    } else {
        light.inner_cone_radians = std::min(turned(light.inner_cone_radians), light.outer_cone_radians);
    }
    return light;
}

} // namespace

double dial_of_angle(double radians) { return dial_start + dial_decade * std::log10(1 + radians / dial_finest); }

double angle_of_dial(double ems) {
    return std::clamp(dial_finest * (std::pow(10, std::max(ems - dial_start, 0.0) / dial_decade) - 1), 0.0, std::numbers::pi);
}

std::optional<double> cone_angle_under(const ViewRay& ray, const Vec3d& apex, const Vec3d& axis, const Projection& projection,
                                       double length) {
    const Vec3d side = silhouette(axis, projection);
    // Seen from the side, the angle is measured in the plane of axis and silhouette; seen along the axis, on a sphere through the
    // cone's rim.
    if (!seen_end_on(axis, projection)) {
        const auto p = meet_plane(ray, apex, cross(axis, side));
        if (!p) return {};
        return std::atan2(std::abs(dot(*p - apex, side)), dot(*p - apex, axis));
    }
    const double b = dot(ray.direction, ray.origin - apex), c = dot(ray.origin - apex, ray.origin - apex) - length * length;
    const double discriminant = std::max(b * b - c, 0.0); // the ray misses the sphere: use its silhouette
    const double toward = dot(axis, ray.direction) > 0 ? 1 : -1;
    const Vec3d p = ray.origin + ray.direction * (-b + toward * std::sqrt(discriminant)) - apex;
    return std::atan2(blush::length(p - axis * dot(p, axis)), dot(p, axis));
}

std::vector<SizeHandle> size_handles(const LightInView& sight, const Projection& projection) {
    const Light& light = sight.light;
    const Affined& m = sight.world_from_node;
    const auto along = [&](const Vec3d& axis, double half) {
        const double scale = length(axis);
        return scale > 0 ? m.t + axis / scale * std::max(half * scale, 1.4 * sight.em) : m.t;
    };
    const SizeHandle ball{Handle::radius, m.t + screen_diagonal(projection) * std::max(light.radius * length(m.x), 1.4 * sight.em)};
    const SizeHandle spread{Handle::spread, cone_point(sight, projection, light.spread_radians / 2, 1)};
    switch (light.kind) {
    case Light::Kind::rectangle:
        return {{Handle::width, along(m.x, light.width / 2.0)}, {Handle::height, along(m.y, light.height / 2.0)}, spread};
    case Light::Kind::disk: return {{Handle::radius, along(m.x, light.radius)}, spread};
    case Light::Kind::point:
    case Light::Kind::sphere: return {ball};
    case Light::Kind::spot:
        return {{Handle::outer_cone, cone_point(sight, projection, light.outer_cone_radians, 1)},
                {Handle::inner_cone, cone_point(sight, projection, light.inner_cone_radians, -1)},
                ball};
    case Light::Kind::sun:
        return {{Handle::sun_angle, m.t + screen_diagonal(projection) * (dial_of_angle(light.angle_radians) * sight.em)}};
    }
    return {};
}

Light resized(const LightInView& start, Handle handle, const Projection& projection, const ViewRay& from, const ViewRay& to) {
    Light light = start.light;
    const Affined& m = start.world_from_node;
    switch (handle) {
    case Handle::width: light.width = with_side(light.width, m.x, m.t, from, to); break;
    case Handle::height: light.height = with_side(light.height, m.y, m.t, from, to); break;
    case Handle::radius: light = with_radius(start, projection, from, to); break;
    case Handle::outer_cone:
    case Handle::inner_cone:
    case Handle::spread: light = with_cone(start, handle, projection, from, to); break;
    case Handle::sun_angle:
        light.angle_radians = float(angle_of_dial(dial_of_angle(light.angle_radians) +
                                                  dragged_along_screen(projection, m.t, from, to) / std::max(start.em, 1e-12)));
        break;
    default: break;
    }
    return with_same_power(start.light, light);
}

} // namespace blush
