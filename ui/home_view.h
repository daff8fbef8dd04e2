// The view that a scene is composed for: that of a camera, or, in a scene without cameras, the one it was opened with.
#pragma once

#include "scene/scene.h"

namespace blush {

struct HomeView {
    Id<Node> camera; // none: `opened`
    View opened;
};

// The camera that the view looks through, else the first of the chosen scene.
HomeView home_at_opening(const Scene& scene);
// As the camera is now; the view at opening where the camera is gone.
View home_view(const Scene& scene, const HomeView& home);
// The scene is seen from the camera's place. True without a camera: every view is a free one.
bool is_at_home(const Scene& scene, const HomeView& home);
// The camera node whose place and direction the view has; none: a free view.
Id<Node> camera_of_view(const Scene& scene);

} // namespace blush
