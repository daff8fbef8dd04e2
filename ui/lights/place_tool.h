// Tool that places the selected light by its effect: a click or drag on a surface moves its highlight or shadow there.
#pragma once

#include "ui/lights/place_by_effect.h"
#include "ui/panel_context.h"
#include "ui/transform/gizmo.h"

#include <imgui.h>

namespace blush {

class PlaceTool {
public:
    // Draws the tool and applies clicks while UiState has it active. Returns true if the tool uses the left button. `hovered`:
    // the mouse is free to press.
    bool update(PanelContext& c, ImDrawList& draw, const Projection& projection, const ImageRect& image, bool hovered);

private:
    std::optional<SurfacePoint> surface_under_mouse(PanelContext& c, const Projection& projection, const ImageRect& image) const;
    // The light's pose for the surface point under the mouse.
    std::optional<LightPose> wanted(PanelContext& c, const Projection& projection, const ImageRect& image, const SurfacePoint& spot) const;
    void press(PanelContext& c, const SurfacePoint& spot);
    void release(PanelContext& c);
    void warn_of_occluder(PanelContext& c) const;
    void draw_preview(ImDrawList& draw, const Projection& projection, const ImageRect& image, const SurfacePoint& spot,
                      const std::optional<LightPose>& pose) const;
    std::string hint(const std::string& light) const;

    PlacingBy by_ = PlacingBy::hand;
    Id<Node> node_;
    bool dragging_ = false, placed_ = false;
    FramePtr surfaces_; // frame at mouse press: the light's own body may later cover the surfaces
    LightPose start_;
    double distance_ = 1;           // distance in metres, constant during the drag
    std::optional<Vec3d> occluder_; // the point whose shadow is placed
    Id<Node> occluder_node_;
    std::optional<Vec3d> effect_at_; // where the highlight or shadow was placed
    ImVec2 pressed_at_{0, 0};
};

} // namespace blush
