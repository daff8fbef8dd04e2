// The handles of the selected node: drawn over the picture, dragged with the mouse, one drag one step of the history. They move, aim and
// resize all that is selected.
#pragma once

#include "ui/light_handles.h"
#include "ui/panels/context.h"

#include <imgui.h>

namespace blush {

class Handles {
public:
    // Draws the selected node's handles and lets the mouse drag them. True while the mouse is on one or drags one: the
    // click is then not the viewport's. `hovered`: the mouse is free to grab.
    bool update(PanelContext& c, ImDrawList& draw, const Projection& projection, const ImageRect& image, bool hovered);

private:
    // Where the handles of a node sit: the middle of its mesh, else its origin.
    Vec3d anchor(const Scene& scene, Id<Node> id, const Node& node);
    void grab(PanelContext& c, Handle handle, const Vec3d& position, const std::optional<LightSight>& seen, const ViewRay& ray);
    void drag(PanelContext& c, const Projection& projection, const ImageRect& image);
    void move(PanelContext& c, const Vec3d& by);
    void aim(PanelContext& c, const Projection& projection, double u, double v);
    std::optional<LightSight> sight(const Scene& scene, Id<Node> id, const Projection& projection, const ImageRect& image) const;

    // What the cached values below belong to: a node, and the first part of its mesh, since a reloaded scene may have another mesh
    // under the same id.
    Id<Node> node_;
    uint64_t geometry_ = 0;
    Vec3d local_anchor_{0, 0, 0};
    double aim_distance_ = 1; // metres from the node to its aim handle

    Handle dragged_ = Handle::none;
    Vec3d start_anchor_{0, 0, 0};
    ViewRay start_ray_{};
    std::optional<LightSight> start_sight_;
    // Selected nodes that hang below none of the others, and where they were.
    struct Grabbed {
        Id<Node> node;
        Vec3d origin;
    };
    std::vector<Grabbed> grabbed_;
};

} // namespace blush
