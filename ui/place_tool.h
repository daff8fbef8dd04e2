// Placing the selected light by its effect: a click on a surface, or a drag over it, brings its highlight or its shadow there.
#pragma once

#include "ui/gizmo.h"
#include "ui/light_placing.h"
#include "ui/panels/context.h"

#include <imgui.h>

namespace blush {

class PlaceTool {
public:
    // Draws what a click would do and does it, while the window's state says so. True if the left button is this tool's now. `hovered`: the
    // mouse is free to press.
    bool update(PanelContext& c, ImDrawList& draw, const Projection& projection, const ImageRect& image, bool hovered);

private:
    std::optional<SurfaceSpot> spot_under_mouse(PanelContext& c, const Projection& projection, const ImageRect& image) const;
    // The light as the spot under the mouse would have it.
    std::optional<LightPose> wanted(PanelContext& c, const Projection& projection, const ImageRect& image, const SurfaceSpot& spot) const;
    void press(PanelContext& c, const SurfaceSpot& spot);
    void release(PanelContext& c);
    void say_what_blocks(PanelContext& c) const;
    void draw_preview(ImDrawList& draw, const Projection& projection, const ImageRect& image, const SurfaceSpot& spot,
                      const std::optional<LightPose>& pose) const;
    std::string hint(const std::string& light) const;

    PlacingBy by_ = PlacingBy::hand;
    Id<Node> node_;
    bool dragging_ = false, placed_ = false;
    FramePtr surfaces_; // as they were when the mouse went down: the light's own body may move in front of them
    LightPose start_;
    double distance_ = 1;           // metres that the drag keeps
    std::optional<Vec3d> occluder_; // whose shadow is placed
    Id<Node> occluder_node_;
    std::optional<Vec3d> effect_at_; // where the highlight or shadow was put
    ImVec2 pressed_at_{0, 0};
};

} // namespace blush
