#include "ui/lights/light_camera.h"

#include "ui/lights/light_tools.h"
#include "ui/transform/rotation.h"
#include "ui/viewport/orbit_camera.h"

namespace blush {
namespace {

Vec3d forward_of(const Quat& rotation) { return rotate(rotation, {0, 0, -1}); }

bool has_place(const Light& light) { return light.kind != Light::Kind::sun; }

} // namespace

double clearance(const Scene& scene, Id<Node> node) {
    const Light& light = *scene.lights.find(scene.nodes.find(node)->light);
    const Affined m = world_from_node(scene, node);
    const double scale = std::max({length(m.x), length(m.y), length(m.z)});
    switch (light.kind) {
    case Light::Kind::point:
    case Light::Kind::sphere: return 1.01 * scale * light.radius;
    case Light::Kind::rectangle: return 1e-3 * scale * std::max(light.width, light.height);
    case Light::Kind::disk:
    case Light::Kind::spot: return 1e-3 * scale * light.radius;
    case Light::Kind::sun: break;
    }
    return 0;
}

View view_through_light(const View& view, const Light& light, const LightPose& pose, double clearance) {
    View through = view;
    if (has_direction(light.kind)) through.rotation = pose.rotation;
    const Vec3d forward = forward_of(through.rotation);
    if (has_place(light))
        through.position = to_float(pose.position + forward * clearance);
    else if (through.rotation != view.rotation) // otherwise rounding would move the pivot
        through.position = to_float(pivot(view) - forward * double(view.pivot_distance));
    return through;
}

LightPose light_pose_of_view(const View& view, const Light& light, const LightPose& pose, double clearance) {
    LightPose moved = pose;
    if (has_direction(light.kind)) moved.rotation = view.rotation;
    if (has_place(light)) moved.position = to_double(view.position) - forward_of(view.rotation) * clearance;
    return moved;
}

View initial_light_view(const View& view, const Light& light, const LightPose& pose, double clearance) {
    View first = view;
    const Vec3d to_pivot = pivot(view) - pose.position;
    if (has_place(light) && length(to_pivot) > 1e-6) {
        first.pivot_distance = float(length(to_pivot));
        if (!has_direction(light.kind)) first.rotation = looking_along(to_pivot);
    }
    return view_through_light(first, light, pose, clearance);
}

} // namespace blush
