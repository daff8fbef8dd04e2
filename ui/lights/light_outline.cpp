#include "ui/lights/light_outline.h"

#include "ui/transform/gizmo.h"
#include "ui/transform/rotation.h"

#include <numbers>

namespace blush {
namespace {

struct Outline {
    std::vector<WorldLine> lines;

    void line(const Vec3d& a, const Vec3d& b) { lines.push_back({a, b}); }
    void ellipse(const Vec3d& centre, const Vec3d& x, const Vec3d& y) {
        constexpr int steps = 48;
        const auto at = [&](int i) {
            return centre + x * std::cos(2 * std::numbers::pi * i / steps) + y * std::sin(2 * std::numbers::pi * i / steps);
        };
        for (int i = 0; i < steps; ++i) line(at(i), at(i + 1));
    }
    // Circle of directions at half_angle around forward.
    void cone(const Vec3d& apex, const Quat& rotation, double half_angle, double length, bool sides) {
        const double angle = std::min(half_angle, 1.5), radius = length * std::sin(angle);
        const Vec3d centre = apex + rotate(rotation, {0, 0, -1}) * (length * std::cos(angle));
        const Vec3d x = rotate(rotation, {1, 0, 0}) * radius, y = rotate(rotation, {0, 1, 0}) * radius;
        ellipse(centre, x, y);
        if (!sides) return;
        for (const Vec3d& side : {x, -x, y, -y}) line(apex, centre + side);
    }
    void rectangle(const Vec3d& centre, const Vec3d& x, const Vec3d& y) {
        const Vec3d corners[] = {centre - x - y, centre + x - y, centre + x + y, centre - x + y};
        for (int i = 0; i < 4; ++i) line(corners[i], corners[(i + 1) % 4]);
    }
    // An arrow on the emitting side.
    void face(const Vec3d& centre, const Quat& rotation, const Light& light, double reach) {
        const Vec3d forward = rotate(rotation, {0, 0, -1});
        line(centre, centre + forward * (reach * 0.5));
        if (light.two_sided) line(centre, centre - forward * (reach * 0.5));
        if (light.spread_radians < std::numbers::pi - 1e-3) cone(centre, rotation, light.spread_radians / 2, reach, true);
    }
    // Parallel rays, and the cone of the sun's angular diameter.
    void sun(const Vec3d& centre, const Quat& rotation, const Light& light, double reach) {
        const Vec3d forward = rotate(rotation, {0, 0, -1}) * reach;
        for (int i = 0; i < 6; ++i) {
            const double a = 2 * std::numbers::pi * i / 6;
            const Vec3d from = centre + rotate(rotation, {std::cos(a), std::sin(a), 0}) * (reach * 0.3);
            line(from, from + forward);
        }
        ellipse(centre, rotate(rotation, {1, 0, 0}) * (reach * 0.3), rotate(rotation, {0, 1, 0}) * (reach * 0.3));
        if (light.angle_radians > 0) cone(centre, rotation, light.angle_radians / 2, reach, true);
    }
};

} // namespace

std::vector<WorldLine> light_outline(const Scene& scene, Id<Node> id, const Light& light, const Projection& projection, double reach) {
    Outline outline;
    const Affined m = world_from_node(scene, id);
    const Quat rotation = world_rotation(scene, id);
    const double radius = light.radius;
    switch (light.kind) {
    case Light::Kind::point:
    case Light::Kind::sphere:
        if (radius > 0) outline.ellipse(m.t, projection.right() * (radius * length(m.x)), projection.up() * (radius * length(m.y)));
        break;
    case Light::Kind::spot:
        outline.cone(m.t, rotation, light.outer_cone_radians, reach, true);
        if (light.inner_cone_radians > 0) outline.cone(m.t, rotation, light.inner_cone_radians, reach, false);
        if (radius > 0) outline.ellipse(m.t, m.x * radius, m.y * radius);
        break;
    case Light::Kind::rectangle:
        outline.rectangle(m.t, m.x * (light.width / 2.0), m.y * (light.height / 2.0));
        outline.face(m.t, rotation, light, reach);
        break;
    case Light::Kind::disk:
        outline.ellipse(m.t, m.x * radius, m.y * radius);
        outline.face(m.t, rotation, light, reach);
        break;
    case Light::Kind::sun: outline.sun(m.t, rotation, light, reach); break;
    }
    return std::move(outline.lines);
}

} // namespace blush
