// The handles of the selected node: drawn over the picture, dragged with the mouse, one drag one step of the history. They move, rotate,
// scale, aim and resize all that is selected.
#pragma once

#include "ui/light_handles.h"
#include "ui/panels/context.h"
#include "ui/transform_edits.h"

#include <imgui.h>
#include <map>
#include <span>

namespace blush {

class Handles {
public:
    // Draws the selected node's handles and lets the mouse drag them. True while the mouse is on one or drags one: the
    // click is then not the viewport's. `hovered`: the mouse is free to grab.
    bool update(PanelContext& c, ImDrawList& draw, const Projection& projection, const ImageRect& image, bool hovered);

private:
    // Where the handles sit: the middle of those of all that is transformed.
    Vec3d anchor(const Scene& scene, std::span<const TransformTarget> targets);
    void grab(PanelContext& c, Handle handle, const std::optional<LightSight>& seen, const ViewRay& ray);
    std::vector<HandleShape> shapes(const PanelContext& c, std::span<const TransformTarget> targets, const Vec3d& position,
                                    const Projection& projection, const ImageRect& image, const std::optional<LightSight>& seen) const;
    void drag(PanelContext& c, const Projection& projection, const ImageRect& image);
    void aim(PanelContext& c, const Projection& projection, double u, double v);
    std::optional<LightSight> sight(const Scene& scene, Id<Node> id, const Projection& projection, const ImageRect& image) const;

    // The middle of a node's mesh in its own space. It belongs to a node and the first part of its mesh, since a reloaded scene may have
    // another mesh under the same id.
    struct Anchor {
        uint64_t geometry = 0;
        Vec3d local{0, 0, 0};
    };
    std::map<Id<Node>, Anchor> anchors_;
    Id<Node> aimed_;          // the node that the distance belongs to
    double aim_distance_ = 1; // metres from the node to its aim handle

    Handle dragged_ = Handle::none;
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
