#include "ui/light_tools.h"

#include "ui/orbit_camera.h"
#include "ui/rotation.h"

namespace blush {
namespace {

constexpr double pi_d = 3.14159265358979323846;
constexpr double degrees = 180 / pi_d;

// Candela towards a surface `distance` metres away that the light faces. One that has no candela is asked for its illuminance there.
double candela(const Light& light, double distance) {
    return light.kind == Light::Kind::sun ? light.intensity * distance * distance : in_unit(light, Light::Unit::candela);
}

double intensity_for(const Light& light, double candela, double distance) {
    return light.kind == Light::Kind::sun ? candela / (distance * distance) : double(intensity_of(light, Light::Unit::candela, candela));
}

} // namespace

const char* kind_name(Light::Kind kind) {
    switch (kind) {
    case Light::Kind::point: return "Point";
    case Light::Kind::spot: return "Spot";
    case Light::Kind::sun: return "Sun";
    case Light::Kind::rectangle: return "Rectangle";
    case Light::Kind::disk: return "Disk";
    case Light::Kind::sphere: return "Sphere";
    }
    return "";
}

const char* intensity_unit(Light::Kind kind) { return kind == Light::Kind::sun ? "lx" : is_per_area(kind) ? "nits" : "cd"; }

bool has_direction(Light::Kind kind) { return kind != Light::Kind::point && kind != Light::Kind::sphere; }
Light converted(const Light& light, Light::Kind kind, double distance) {
    Light next = light;
    next.kind = kind;
    if (is_per_area(kind) && next.radius <= 0) next.radius = 0.1f; // a disk and a sphere need one
    next.intensity = float(intensity_for(next, candela(light, distance), distance));
    return next;
}

AddLight new_light(Light::Kind kind, const View& view, float exposure_ev) {
    // Within the picture: measured by what the view shows at the pivot.
    const double reach = view.lens.orthographic ? 2.0 * view.lens.ymag : 2 * view.pivot_distance * std::tan(view.lens.yfov_radians / 2.0);
    const Vec3d target = pivot(view), right = rotate(view.rotation, {1, 0, 0}), back = rotate(view.rotation, {0, 0, 1});
    const Vec3d position = target + Vec3d{0, 1, 0} * (0.35 * reach) + right * (0.2 * reach) + back * (0.1 * reach);
    AddLight add;
    add.light.name = add.node.name = kind_name(kind);
    add.light.kind = kind;
    add.light.width = add.light.height = float(0.2 * reach);
    if (is_per_area(kind)) add.light.radius = float(0.1 * reach);
    add.light.outer_cone_radians = 0.5f;
    add.light.inner_cone_radians = 0.4f;
    add.light.angle_radians = kind == Light::Kind::sun ? 0.00925f : 0;
    // White is reflectance x illuminance / pi = 1 at exposure 0.
    const double illuminance = pi_d * std::exp2(-exposure_ev), distance = length(target - position);
    add.light.intensity = float(intensity_for(add.light, illuminance * distance * distance, distance));
    add.node.local.translation = to_float(position);
    add.node.local.rotation = looking_along(target - position);
    return add;
}

float turned_rotation(float rotation_degrees, double share, const Lens& lens) {
    const double tangent = lens.orthographic ? 1 : 2 * std::tan(lens.yfov_radians / 2.0); // that the height spans
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

Quat turned_to(const Quat& rotation, const Vec3d& forward) {
    const Vec3d from = rotate(rotation, {0, 0, -1}), to = normalize(forward), axis = cross(from, to);
    const double sine = length(axis), cosine = dot(from, to);
    if (sine < 1e-9) return cosine > 0 ? rotation : normalized(multiply(axis_angle(rotate(rotation, {0, 1, 0}), pi_d), rotation));
    return normalized(multiply(axis_angle(axis / sine, std::atan2(sine, cosine)), rotation));
}

} // namespace blush
