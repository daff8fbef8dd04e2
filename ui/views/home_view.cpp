#include "ui/views/home_view.h"

#include "scene/animation/pose.h"

namespace blush {
namespace {

bool same_place(const View& a, const View& b) {
    return a.position == b.position && a.rotation == b.rotation && (!a.lens.orthographic || a.lens.ymag == b.lens.ymag);
}

} // namespace

Id<Node> camera_of_view(const Scene& scene) {
    for (const auto& [id, node] : scene.nodes)
        if (node.camera && is_in_chosen_scene(scene, id) && same_place(view_of_camera(scene, id), scene.view)) return id;
    return {};
}

HomeView home_at_opening(const Scene& scene) {
    HomeView home{camera_of_view(scene), scene.view};
    if (home.camera) return home;
    for (const auto& [id, node] : scene.nodes)
        if (node.camera && is_in_chosen_scene(scene, id)) return {id, scene.view};
    return home;
}

View home_view(const Scene& scene, const HomeView& home) {
    const Node* node = scene.nodes.find(home.camera);
    return node && scene.cameras.contains(node->camera) ? view_through(scene, home.camera) : home.opened;
}

bool is_at_home(const Scene& scene, const HomeView& home) {
    const Node* node = scene.nodes.find(home.camera);
    return !node || !scene.cameras.contains(node->camera) || same_place(view_of_camera(scene, home.camera), scene.view);
}

} // namespace blush
