// Looking through a light: the view that sees with its eyes, and the light that follows such a view. Pure.
#pragma once

#include "ui/light_placing.h"

namespace blush {

// How far before a light's centre the eye stands so as not to look into its body, in metres.
double clearance(const Scene& scene, Id<Node> light_node);

// `view` moved so that it looks out of the light. A sun has no place: its direction is taken and the pivot stays. A point and a sphere have
// no direction: the view's stays. The view itself where it does so already.
View view_through_light(const View& view, const Light& light, const LightPose& pose, double clearance);
// The light moved so that `view` looks out of it, as far as it has a place and a direction.
LightPose pose_behind_view(const View& view, const Light& light, const LightPose& pose, double clearance);
// `view` turned towards its pivot from where the light is: what looking through it begins with.
View first_view_through_light(const View& view, const Light& light, const LightPose& pose, double clearance);

} // namespace blush
