#include "ui/lights/look_through_light.h"

#include "ui/lights/light_camera.h"

namespace blush {

const Light* light_camera_light(const PanelContext& c) {
    const Node* node = c.ui.light_camera ? c.scene().nodes.find(c.ui.light_camera->node) : nullptr;
    return node ? c.scene().lights.find(node->light) : nullptr;
}

void move_view_to_light(PanelContext& c) {
    if (!c.ui.light_camera) return;
    const Light* light = light_camera_light(c);
    if (!light) { // deleted, or its creation was undone
        c.document.navigate(c.ui.light_camera->back);
        return c.ui.light_camera.reset();
    }
    const Id<Node> id = c.ui.light_camera->node;
    c.document.navigate(view_through_light(c.scene().view, *light, pose_of(c.scene(), id), clearance(c.scene(), id)));
}

void move_light_to_view(PanelContext& c) {
    const Light* light = light_camera_light(c);
    if (!light) return;
    const Id<Node> id = c.ui.light_camera->node;
    const LightPose pose = light_pose_of_view(c.scene().view, *light, pose_of(c.scene(), id), clearance(c.scene(), id));
    c.apply(SetNode{id, with_pose(c.scene(), id, pose)}, c.ui.gestures.current());
    move_view_to_light(c);
}

} // namespace blush
