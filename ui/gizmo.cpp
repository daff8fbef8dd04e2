#include "ui/gizmo.h"

#include "ui/rotation.h"

namespace blush {
namespace {

float distance(ScreenPoint a, ScreenPoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

float distance_to_segment(ScreenPoint p, ScreenPoint a, ScreenPoint b) {
    const float dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
    const float t = squared > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.f, 1.f) : 0.f;
    return distance(p, {a.x + t * dx, a.y + t * dy});
}

Affined world_from_parent(const Scene& scene, const Node& node) { return node.parent ? world_from_node(scene, node.parent) : Affined{}; }

// A parent scaled to nothing has no inverse; its children then cannot be placed in the world and stay as they are.
bool invertible(const Affined& m) { return std::abs(determinant(m)) > 1e-300; }

} // namespace

std::vector<HandleShape> handle_shapes(const Projection& projection, const ImageRect& image, const Vec3d& position,
                                       const std::optional<Vec3d>& aim_at, float size) {
    std::vector<HandleShape> shapes;
    const auto centre = projection.project(position);
    if (!centre) return shapes;
    const ScreenPoint from = image.at(*centre);
    const double world_size = projection.height_at(centre->distance) * size / image.height;
    shapes.push_back({Handle::move, from, from});
    for (const Handle handle : {Handle::move_x, Handle::move_y, Handle::move_z}) {
        const auto end = projection.project(position + axis_of(handle) * world_size);
        if (!end) continue;
        const ScreenPoint grip = image.at(*end);
        if (distance(from, grip) > size / 5) shapes.push_back({handle, from, grip});
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
        if (d < best) {
            best = d;
            nearest = shape.handle;
        }
    }
    if (nearest != Handle::none) return nearest;
    best = reach / 2;
    for (const HandleShape& shape : shapes) {
        if (shape.handle == Handle::aim || is_size(shape.handle)) continue; // their lines cross the picture; only grips are to be grabbed
        const float d = distance_to_segment(mouse, shape.from, shape.grip);
        if (d < best) {
            best = d;
            nearest = shape.handle;
        }
    }
    return nearest;
}

Vec3d axis_of(Handle handle) {
    switch (handle) {
    case Handle::move_x: return {1, 0, 0};
    case Handle::move_y: return {0, 1, 0};
    default: return {0, 0, 1};
    }
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

Vec3d dragged_position(Handle handle, const Projection& projection, const ViewRay& start, const ViewRay& now, const Vec3d& position) {
    if (handle == Handle::move) {
        const auto a = meet_plane(start, position, projection.forward()), b = meet_plane(now, position, projection.forward());
        return a && b ? position + (*b - *a) : position;
    }
    const auto a = nearest_on_axis(start, position, axis_of(handle)), b = nearest_on_axis(now, position, axis_of(handle));
    return a && b ? position + axis_of(handle) * (*b - *a) : position;
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
    // Z and Y say where a light or camera looks and what is up; X follows, so that a mirrored node still gets a rotation.
    if (length(m.z) == 0 || length(cross(m.y, m.z)) == 0) return {};
    const Vec3d z = normalize(m.z), x = normalize(cross(m.y, m.z));
    return to_quat(Affined{x, cross(z, x), z, {0, 0, 0}});
}

} // namespace blush
