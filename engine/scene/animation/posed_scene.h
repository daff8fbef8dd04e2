// A scene at the chosen time of its animation, as a scene without animation.
#pragma once

#include "scene/scene.h"

namespace blush {

// The scene with the animated pose and the chosen scene baked into its nodes and the selection reset: it looks the same. Nodes
// whose animated transform is not finite are hidden.
Scene with_pose_applied(const Scene& scene);

} // namespace blush
