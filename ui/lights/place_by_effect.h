// Places a light by its effect: where its highlight or shadow falls. Pure; positions in world metres.
#pragma once

#include "scene/scene.h"
#include "ui/viewport/picking.h"

namespace blush {

// Pose of a light: it emits along the -Z of its rotation.
struct LightPose {
    Vec3d position{0, 0, 0};
    Quat rotation;
};
LightPose pose_of(const Scene& scene, Id<Node> node);
// The node with that pose, scale unchanged.
Node with_pose(const Scene& scene, Id<Node> node, const LightPose& pose);

// The pose in which a viewer looking along `view` sees the light's mirror reflection at `spot`, `distance` metres from the spot.
// A light with a direction is turned towards the spot.
LightPose with_highlight_at(const Light& light, const LightPose& pose, const SurfacePoint& spot, const Vec3d& view, double distance);

// The pose in which the shadow of `occluder` falls on `target`: on the line through both, `distance` metres beyond the occluder;
// a light with a direction is turned along the line. Returns the unchanged pose if the two points coincide.
LightPose with_shadow_at(const Light& light, const LightPose& pose, const Vec3d& occluder, const Vec3d& target, double distance);

// True if the surface at the spot faces the light, so that its light can reach it.
bool faces(const SurfacePoint& spot, const Vec3d& position);

} // namespace blush
