// What surrounds a region that is rendered alone: the last picture of everything, dimmed, until there is a new one.
#pragma once

#include "scene/picture_region.h"
#include "ui/display_pass.h"
#include "ui/frame_pace.h"
#include "ui/gizmo.h"
#include "ui/picture_view.h"

#include <array>
#include <imgui.h>
#include <optional>

namespace blush {

class RegionSurroundings {
public:
    void set_shader(const DisplayShader& shader);
    // The picture on the screen, with what is denoised of it; kept if it is a whole one.
    void remember(const FramePtr& frame, const DenoisedPtr& denoised);
    // There is nothing to go back to: another scene.
    void forget();
    // Is there such a picture, and is it drawn?
    bool ready() const { return drawn_; }
    // Works at it for as long as there is time, as it is looked at now. Returns false while there is more to do.
    bool update(const DisplayLook& look, const PictureView& view, const FramePace& pace);
    // Draws it dimmed around the region, `image` being where the whole picture lies.
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

// The parts of a picture outside of a region, as shares of its sides: above, below, left, right.
std::array<PictureRegion, 4> around(const PictureRegion& region);

} // namespace blush
