#include "ui/lights/light_tools.h"

#include "ui/transform/rotation.h"

#include <numbers>

namespace blush {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

// Candela towards a surface that faces the light at `distance` metres. For lights without candela, computed from the illuminance
// there.
double candela(const Light& light, double distance) {
    return light.kind == Light::Kind::sun ? light.intensity * distance * distance : in_unit(light, Light::Unit::candela);
}

} // namespace

float intensity_towards(const Light& light, double candela, double distance) {
    return light.kind == Light::Kind::sun ? float(candela / (distance * distance)) : intensity_of(light, Light::Unit::candela, candela);
}

const char* intensity_unit(Light::Kind kind) { return kind == Light::Kind::sun ? "lx" : is_per_area(kind) ? "nits" : "cd"; }

bool has_direction(Light::Kind kind) { return kind != Light::Kind::point && kind != Light::Kind::sphere; }
Light converted(const Light& light, Light::Kind kind, double distance) {
    Light next = light;
    next.kind = kind;
    if (is_per_area(kind) && next.radius <= 0) next.radius = 0.1f; // disk and sphere need a radius
    next.intensity = intensity_towards(next, candela(light, distance), distance);
    return next;
}

float turned_rotation(float rotation_degrees, double share, const Lens& lens) {
    const double tangent = lens.orthographic ? 1 : 2 * std::tan(lens.yfov_radians / 2.0); // height of the image plane at distance 1
    return float(std::remainder(rotation_degrees - share * tangent * degrees, 360));
}

Heading heading_of(const Vec3d& direction) {
    const double horizontal = std::hypot(direction.x, direction.z);
    const double heading = horizontal > 1e-9 ? std::atan2(direction.x, -direction.z) * degrees : 0;
    return {float(heading), float(std::atan2(direction.y, horizontal) * degrees)};
}

Vec3d direction_of(const Heading& h) {
    const double heading = h.heading / degrees, tilt = h.tilt / degrees;
    return {std::sin(heading) * std::cos(tilt), std::sin(tilt), -std::cos(heading) * std::cos(tilt)};
}

Heading heading_of_rotation(const Quat& rotation) {
    const Vec3d forward = rotate(rotation, {0, 0, -1});
    Heading heading = heading_of(forward);
    constexpr double nearly_vertical = 1e-4; // horizontal part of a unit vector that is too short for a direction in single precision
    if (std::hypot(forward.x, forward.z) < nearly_vertical)
        heading.heading = heading_of(rotate(rotation, {0, forward.y < 0 ? 1.0 : -1.0, 0})).heading;
    return heading;
}

Quat with_heading(const Quat& rotation, const Heading& heading) {
    const Heading now = heading_of_rotation(rotation);
    const double turn = (heading.heading - now.heading) / degrees, across = heading.heading / degrees;
    const Vec3d right{std::cos(across), 0, std::sin(across)};
    const Quat turned = multiply(axis_angle({0, 1, 0}, -turn), rotation);
    return normalized(multiply(axis_angle(right, (heading.tilt - now.tilt) / degrees), turned));
}

Quat turned_to(const Quat& rotation, const Vec3d& forward) {
    const Vec3d from = rotate(rotation, {0, 0, -1}), to = normalize(forward), axis = cross(from, to);
    const double sine = length(axis), cosine = dot(from, to);
    if (sine < 1e-9)
        return cosine > 0 ? rotation : normalized(multiply(axis_angle(rotate(rotation, {0, 1, 0}), std::numbers::pi), rotation));
    return normalized(multiply(axis_angle(axis / sine, std::atan2(sine, cosine)), rotation));
}

} // namespace blush
