#include "ui/transform/gizmo.h"

#include "ui/transform/rotation.h"

#include <cfloat>
#include <numbers>

namespace blush {
namespace {

float distance(ScreenPoint a, ScreenPoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

float distance_to_segment(ScreenPoint p, ScreenPoint a, ScreenPoint b) {
    const float dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
    const float t = squared > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.f, 1.f) : 0.f;
    return distance(p, {a.x + t * dx, a.y + t * dy});
}

float distance_to_line(ScreenPoint p, const std::vector<ScreenPoint>& line) {
    float nearest = FLT_MAX;
    for (size_t i = 1; i < line.size(); ++i) nearest = std::min(nearest, distance_to_segment(p, line[i - 1], line[i]));
    return nearest;
}

// A parent with scale 0 has no inverse; its children keep their transform.
bool invertible(const Affined& m) { return std::abs(determinant(m)) > 1e-300; }

// Unit length.
Vec3d towards_eye(const Projection& projection, const Vec3d& from) {
    if (projection.height_at(1) == projection.height_at(2)) return -projection.forward(); // orthographic
    const Vec3d to = projection.eye() - from;
    return length(to) > 0 ? normalize(to) : -projection.forward();
}

// The half of a ring that faces the viewer, from end to end.
std::vector<ScreenPoint> projected_ring(const Projection& projection, const ImageRect& image, const Vec3d& centre, const Vec3d& axis,
                                        double radius) {
    constexpr int steps = 96;
    const Vec3d towards = towards_eye(projection, centre);
    const Vec3d across = towards - axis * dot(axis, towards);
    const double slant = length(across);
    const Vec3d x = slant > 1e-6 ? across / slant : any_perpendicular(axis), y = cross(axis, x);
    std::vector<ScreenPoint> points;
    for (int i = -steps / 2; i <= steps / 2; ++i) {
        const double a = 2 * std::numbers::pi * i / steps;
        if (std::cos(a) * slant < -0.05) continue;
        if (const auto seen = projection.project(centre + (x * std::cos(a) + y * std::sin(a)) * radius)) points.push_back(image.at(*seen));
    }
    return points;
}

HandleShape ring_shape(Handle handle, ScreenPoint from, std::vector<ScreenPoint> ring) {
    const ScreenPoint grip = ring[ring.size() / 4]; // not in the middle: near sides of several rings may coincide
    return {handle, from, grip, std::move(ring)};
}

Handle handle_of(TransformMode mode, int axis) {
    const Handle first = mode == TransformMode::grab ? Handle::move : mode == TransformMode::rotate ? Handle::rotate : Handle::scale;
    return Handle(int(first) + 1 + axis);
}

} // namespace

bool is_of_gizmo(Handle handle, TransformMode mode) {
    const int first = int(handle_of(mode, -1));
    return int(handle) >= first && int(handle) <= first + 3;
}

int axis_of(Handle handle) {
    for (const TransformMode mode : {TransformMode::grab, TransformMode::rotate, TransformMode::scale})
        if (is_of_gizmo(handle, mode)) return int(handle) - int(handle_of(mode, 0));
    return -1;
}

std::vector<HandleShape> handle_shapes(const Projection& projection, const ImageRect& image, const GizmoPlace& place,
                                       const std::optional<Vec3d>& aim_at) {
    std::vector<HandleShape> shapes;
    const auto centre = projection.project(place.position);
    if (!centre) return shapes;
    const ScreenPoint from = image.at(*centre);
    const double world_size = projection.height_at(centre->distance) * place.size / image.height;
    if (place.mode == TransformMode::rotate) {
        auto round = projected_ring(projection, image, place.position, -towards_eye(projection, place.position), world_size * 1.25);
        if (round.size() > 4) shapes.push_back(ring_shape(Handle::rotate, from, std::move(round)));
    } else {
        shapes.push_back({handle_of(place.mode, -1), from, from});
    }
    for (int i = 0; i < 3 && place.along_axes; ++i) {
        const Vec3d axis = place.axes[size_t(i)];
        if (place.mode == TransformMode::rotate) {
            auto ring = projected_ring(projection, image, place.position, axis, world_size);
            if (ring.size() > 4) shapes.push_back(ring_shape(handle_of(place.mode, i), from, std::move(ring)));
            continue;
        }
        const auto end = projection.project(place.position + axis * world_size);
        if (!end) continue;
        const ScreenPoint grip = image.at(*end);
        if (distance(from, grip) > place.size / 5) shapes.push_back({handle_of(place.mode, i), from, grip});
    }
    if (aim_at) {
        if (const auto target = projection.project(*aim_at)) shapes.push_back({Handle::aim, from, image.at(*target)});
    }
    return shapes;
}

Handle handle_under(const std::vector<HandleShape>& shapes, ScreenPoint mouse, float reach) {
    Handle nearest = Handle::none;
    float best = reach;
    for (const HandleShape& shape : shapes) {
        const float d = distance(mouse, shape.grip);
        if (d < best && shape.ring.empty()) {
            best = d;
            nearest = shape.handle;
        }
    }
    if (nearest != Handle::none) return nearest;
    best = reach / 2;
    for (const HandleShape& shape : shapes) {
        if (shape.handle == Handle::aim || is_size(shape.handle)) continue; // their lines cross the image; only the grips can be grabbed
        const float d = shape.ring.empty() ? distance_to_segment(mouse, shape.from, shape.grip) : distance_to_line(mouse, shape.ring);
        if (d < best) {
            best = d;
            nearest = shape.handle;
        }
    }
    return nearest;
}

std::optional<Vec3d> meet_plane(const ViewRay& ray, const Vec3d& point, const Vec3d& normal) {
    const double facing = dot(ray.direction, normal);
    if (std::abs(facing) < 1e-9) return {};
    const double t = dot(point - ray.origin, normal) / facing;
    if (t <= 0) return {};
    return ray.origin + ray.direction * t;
}

std::optional<double> nearest_on_axis(const ViewRay& ray, const Vec3d& origin, const Vec3d& axis) {
    const double b = dot(axis, ray.direction), denominator = 1 - b * b;
    if (denominator < 1e-6) return {};
    const Vec3d w = origin - ray.origin;
    return (b * dot(ray.direction, w) - dot(axis, w)) / denominator;
}

std::optional<double> ring_angle(const ViewRay& ray, const Vec3d& centre, const Vec3d& axis) {
    constexpr double edge_on = 0.15; // cosine between ray and axis
    if (std::abs(dot(ray.direction, axis)) < edge_on) return {};
    const auto met = meet_plane(ray, centre, axis);
    if (!met) return {};
    const Vec3d x = any_perpendicular(axis), y = cross(axis, x), to = *met - centre;
    return std::atan2(dot(to, y), dot(to, x));
}

double edge_on_ring_angle(const Projection& projection, const Vec3d& centre, const Vec3d& axis, ScreenPoint from, ScreenPoint to,
                          float radius) {
    // For a right-handed rotation, the near side moves in this direction.
    const Vec3d way = cross(axis, towards_eye(projection, centre));
    const double x = dot(way, projection.right()), y = -dot(way, projection.up()), n = std::hypot(x, y);
    return n > 0 ? ((to.x - from.x) * x + (to.y - from.y) * y) / (n * radius) : 0;
}

Transform moved_to(const Scene& scene, Id<Node> id, const Vec3d& world_position) {
    const Node& node = *scene.nodes.find(id);
    const Affined world_from = world_from_parent(scene, node);
    if (!invertible(world_from)) return node.local;
    const Vec3d p = transform_point(inverse(world_from), world_position);
    Transform local = node.local;
    local.translation = to_float(p);
    if (local.matrix) local.matrix->t = local.translation;
    return local;
}

Transform rotated_to(const Scene& scene, Id<Node> id, const Quat& rotation) {
    return placed_at(scene, id, world_from_node(scene, id).t, rotation);
}

Transform placed_at(const Scene& scene, Id<Node> id, const Vec3d& position, const Quat& rotation) {
    const Node& node = *scene.nodes.find(id);
    const Affined world_from = world_from_parent(scene, node);
    if (!invertible(world_from)) return node.local;
    const Affined before = world_from_node(scene, id);
    const Affined after{rotate(rotation, {1, 0, 0}) * length(before.x), rotate(rotation, {0, 1, 0}) * length(before.y),
                        rotate(rotation, {0, 0, 1}) * length(before.z), position};
    return to_transform(inverse(world_from) * after);
}

Quat world_rotation(const Scene& scene, Id<Node> id) {
    const Affined m = world_from_node(scene, id);
    // Z and Y are the view and up directions of a light or camera; X follows, so that a mirrored node still has a rotation.
    if (length(m.z) == 0 || length(cross(m.y, m.z)) == 0) return {};
    const Vec3d z = normalize(m.z), x = normalize(cross(m.y, m.z));
    return to_quat(Affined{x, cross(z, x), z, {0, 0, 0}});
}

} // namespace blush
