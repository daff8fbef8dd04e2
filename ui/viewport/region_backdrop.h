// The last whole picture, drawn dimmed around a render region.
#pragma once

#include "scene/picture_region.h"
#include "ui/gl/display_pass.h"
#include "ui/snapshots/picture_view.h"
#include "ui/transform/gizmo.h"
#include "ui/window/frame_budget.h"

#include <array>
#include <imgui.h>
#include <optional>

namespace blush {

class RegionBackdrop {
public:
    void set_shader(const DisplayShader& shader);
    // The displayed frame and its denoised picture; kept if the frame is a whole picture.
    void remember(const FramePtr& frame, const DenoisedPtr& denoised);
    // Forgets the picture, for a new scene.
    void forget();
    // True if there is such a picture and it is ready to be drawn.
    bool ready() const { return drawn_; }
    // Continues to render it with the current view settings while there is time. Returns false while it is not finished.
    bool update(const DisplayLook& look, const PictureView& view, const FrameBudget& pace);
    // Draws it dimmed around the region; `image` is the rectangle of the whole picture.
    void draw(ImDrawList& draw, const ImageRect& image, const PictureRegion& region) const;

private:
    FramePtr frame_;
    DenoisedPtr denoised_;
    DisplayPass pass_;
    std::optional<DisplayShader> shader_;
    bool shader_changed_ = false, drawn_ = false;
    struct Shown {
        FramePtr frame;
        DisplayLook look;
        PictureView view;
        bool operator==(const Shown&) const = default;
    } shown_;
};

// The parts of a picture outside a region, as fractions of its sides: above, below, left, right.
std::array<PictureRegion, 4> around(const PictureRegion& region);

} // namespace blush
