// Light camera: the view from a light, and the light moved by that view. Pure.
#pragma once

#include "ui/lights/place_by_effect.h"

namespace blush {

// Metres from a light's centre to the view position, so that the view is outside its body.
double clearance(const Scene& scene, Id<Node> light_node);

// The view from the light. A sun has no position: only its direction is used, and the pivot does not move. A point and a sphere
// have no direction: the view keeps its own. Returns `view` unchanged if it already matches.
View view_through_light(const View& view, const Light& light, const LightPose& pose, double clearance);
// The light moved so that `view` is the view from it, as far as it has position and direction.
LightPose light_pose_of_view(const View& view, const Light& light, const LightPose& pose, double clearance);
// The view from the light's position towards the current pivot: the start of the light camera.
View initial_light_view(const View& view, const Light& light, const LightPose& pose, double clearance);

} // namespace blush
