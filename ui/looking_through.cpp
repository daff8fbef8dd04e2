#include "ui/looking_through.h"

#include "ui/light_view.h"

namespace blush {

const Light* looked_through_light(const PanelContext& c) {
    const Node* node = c.ui.looked_through ? c.scene().nodes.find(c.ui.looked_through->node) : nullptr;
    return node ? c.scene().lights.find(node->light) : nullptr;
}

void follow_looked_through(PanelContext& c) {
    if (!c.ui.looked_through) return;
    const Light* light = looked_through_light(c);
    if (!light) { // deleted, or its creation was undone
        c.document.navigate(c.ui.looked_through->back);
        return c.ui.looked_through.reset();
    }
    const Id<Node> id = c.ui.looked_through->node;
    c.document.navigate(view_through_light(c.scene().view, *light, pose_of(c.scene(), id), clearance(c.scene(), id)));
}

void carry_light_along(PanelContext& c) {
    const Light* light = looked_through_light(c);
    if (!light) return;
    const Id<Node> id = c.ui.looked_through->node;
    const LightPose pose = pose_behind_view(c.scene().view, *light, pose_of(c.scene(), id), clearance(c.scene(), id));
    c.apply(SetNode{id, with_pose(c.scene(), id, pose)}, c.ui.gestures.current());
    follow_looked_through(c);
}

} // namespace blush
