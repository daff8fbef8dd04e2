#include "ui/lights/place_by_effect.h"

#include "core/math.h"
#include "ui/lights/light_tools.h"
#include "ui/transform/gizmo.h"

namespace blush {
namespace {

LightPose directed(const Light& light, const LightPose& pose, const Vec3d& position, const Vec3d& forward) {
    return {position, has_direction(light.kind) ? turned_to(pose.rotation, forward) : pose.rotation};
}

} // namespace

LightPose pose_of(const Scene& scene, Id<Node> node) { return {world_from_node(scene, node).t, world_rotation(scene, node)}; }

Node with_pose(const Scene& scene, Id<Node> id, const LightPose& pose) {
    Node node = *scene.nodes.find(id);
    const bool turned = pose.rotation != world_rotation(scene, id);
    node.local = turned ? placed_at(scene, id, pose.position, pose.rotation) : moved_to(scene, id, pose.position);
    return node;
}

LightPose with_highlight_at(const Light& light, const LightPose& pose, const SurfacePoint& spot, const Vec3d& view, double distance) {
    const Vec3d wo = normalize(-view), n = dot(spot.normal, wo) < 0 ? -spot.normal : spot.normal;
    const Vec3d wi = n * (2 * dot(n, wo)) - wo;
    return directed(light, pose, spot.position + wi * distance, -wi);
}

LightPose with_shadow_at(const Light& light, const LightPose& pose, const Vec3d& occluder, const Vec3d& target, double distance) {
    const Vec3d back = occluder - target;
    if (!(length(back) > 1e-9)) return pose;
    const Vec3d wi = normalize(back);
    return directed(light, pose, occluder + wi * distance, -wi);
}

bool faces(const SurfacePoint& spot, const Vec3d& position) { return dot(spot.normal, position - spot.position) > 0; }

} // namespace blush
