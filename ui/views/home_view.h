// The home view of a scene: its camera's view or, in a scene without cameras, the view at opening.
#pragma once

#include "scene/scene.h"

namespace blush {

struct HomeView {
    Id<Node> camera; // null id: use `opened`
    View opened;
};

// The camera that the view looks through, else the first camera of the current scene.
HomeView home_at_opening(const Scene& scene);
// The camera's current view; the view at opening if the camera was deleted.
View home_view(const Scene& scene, const HomeView& home);
// True if the view has the camera's pose. True without a camera: every view is then a free one.
bool is_at_home(const Scene& scene, const HomeView& home);
// The camera node that has the view's pose; null id: a free view.
Id<Node> camera_of_view(const Scene& scene);

} // namespace blush
