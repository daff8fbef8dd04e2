// Placing a light by what it does: where its highlight or its shadow falls. Pure; positions in world metres.
#pragma once

#include "scene/scene.h"
#include "ui/picking.h"

namespace blush {

// Where a light is and which way it shines: along -Z of its rotation.
struct LightPose {
    Vec3d position{0, 0, 0};
    Quat rotation;
};
LightPose pose_of(const Scene& scene, Id<Node> node);
// The node in that pose, its scale untouched.
Node with_pose(const Scene& scene, Id<Node> node, const LightPose& pose);

// The light where a viewer who looks along `view` sees its mirror image at `spot`, `distance` metres from there. One with a direction is
// turned to shine at the spot.
LightPose with_highlight_at(const Light& light, const LightPose& pose, const SurfaceSpot& spot, const Vec3d& view, double distance);

// The light where the shadow of `occluder` falls on `target`: on their line, `distance` metres beyond the occluder, turned to shine along
// it if it has a direction. The pose itself where the two points are one.
LightPose with_shadow_at(const Light& light, const LightPose& pose, const Vec3d& occluder, const Vec3d& target, double distance);

// The spot faces the light's place: light can reach it from there.
bool faces(const SurfaceSpot& spot, const Vec3d& position);

} // namespace blush
