// The handles of the selection: drawn over the image, dragged with the mouse, one undo step per drag. They move, rotate, scale,
// aim and resize all selected nodes.
#pragma once

#include "ui/lights/light_handles.h"
#include "ui/panel_context.h"
#include "ui/transform/transform_edits.h"

#include <imgui.h>
#include <map>
#include <span>

namespace blush {

class Handles {
public:
    // Draws the selected node's handles and handles mouse drags. True while the mouse is on a handle or drags one: the viewport
    // then ignores the click. `hovered`: the mouse is free to grab.
    bool update(PanelContext& c, ImDrawList& draw, const Projection& projection, const ImageRect& image, bool hovered);

private:
    // The handles' centre: the mean of the centres of all transformed nodes.
    Vec3d anchor(const Scene& scene, std::span<const TransformTarget> targets);
    void grab(PanelContext& c, Handle handle, const std::optional<LightInView>& seen, const ViewRay& ray);
    std::vector<HandleShape> shapes(const PanelContext& c, std::span<const TransformTarget> targets, const Vec3d& position,
                                    const Projection& projection, const ImageRect& image, const std::optional<LightInView>& seen) const;
    void drag(PanelContext& c, const Projection& projection, const ImageRect& image);
    void aim(PanelContext& c, const Projection& projection, double u, double v);
    std::optional<LightInView> light_in_view(const Scene& scene, Id<Node> id, const Projection& projection, const ImageRect& image) const;

    // The centre of a node's mesh in local space. The key is the node and the first part of its mesh, because after a reload the
    // same id may have another mesh.
    struct Anchor {
        uint64_t geometry = 0;
        Vec3d local{0, 0, 0};
    };
    std::map<Id<Node>, Anchor> anchors_;
    Id<Node> aimed_;          // the node that aim_distance_ belongs to
    double aim_distance_ = 1; // metres from the node to its aim handle

    Handle dragged_ = Handle::none;
    ViewRay start_ray_{};
    std::optional<LightInView> start_in_view_;
    // Selected nodes that are not descendants of other selected ones, with their initial transforms.
    struct Grabbed {
        Id<Node> node;
        Vec3d origin;
    };
    std::vector<Grabbed> grabbed_;
};

} // namespace blush
