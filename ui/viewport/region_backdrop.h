// The last whole image, drawn dimmed around a render region.
#pragma once

#include "scene/image_region.h"
#include "ui/gl/display_pass.h"
#include "ui/snapshots/image_view.h"
#include "ui/transform/gizmo.h"
#include "ui/window/frame_budget.h"

#include <array>
#include <imgui.h>
#include <optional>

namespace blush {

class RegionBackdrop {
public:
    void set_shader(const DisplayShader& shader);
    // The displayed frame and its denoised image; kept if the frame is a whole image.
    void remember(const FramePtr& frame, const DenoisedPtr& denoised);
    // Forgets the image, for a new scene.
    void forget();
    // True if there is such an image and it is ready to be drawn.
    bool ready() const { return drawn_; }
    // Continues to render it with the current view settings while there is time. Returns false while it is not finished.
    bool update(const DisplayLook& look, const ImageView& view, const FrameBudget& pace);
    // Draws it dimmed around the region; `image` is the rectangle of the whole image.
    void draw(ImDrawList& draw, const ImageRect& image, const ImageRegion& region) const;

private:
    FramePtr frame_;
    DenoisedPtr denoised_;
    DisplayPass pass_;
    std::optional<DisplayShader> shader_;
    bool shader_changed_ = false, drawn_ = false;
    struct Shown {
        FramePtr frame;
        DisplayLook look;
        ImageView view;
        bool operator==(const Shown&) const = default;
    } shown_;
};

// The parts of an image outside a region, as fractions of its sides: above, below, left, right.
std::array<ImageRegion, 4> around(const ImageRegion& region);

} // namespace blush
