// Compares two images in the viewport: wipe, flicker or difference. Draws over the viewport's image.
#pragma once

#include "ui/gl/display_pass.h"
#include "ui/jobs/async_query.h"
#include "ui/panel_context.h"
#include "ui/snapshots/difference.h"
#include "ui/transform/gizmo.h"
#include "ui/window/frame_budget.h"

#include <optional>
#include <string>

namespace blush {

// One side: a snapshot's images, or the live ones.
struct ComparedSide {
    uint64_t id = live_image;
    std::string label;
    Images images;
};
// Null frames if there is no such image.
ComparedSide compared_side(const PanelContext& c, uint64_t id);

// A wipe bar at `x` over the visible part of the image, in a window of its own. True while it is dragged. `name`: unique, also in the
// probe.
bool drag_wipe(UiState& ui, const char* name, float x, const ImageRect& seen);

// The name of the whole image, and those of both sides of a wipe.
void name_image(const std::string& text, const ImageRect& seen);
void name_sides(const std::string& a, const std::string& b, const ImageRect& seen);

class CompareView {
public:
    void set_shader(const DisplayShader& shader);
    // `image` is the rectangle of the whole image, `seen` its visible part. The live image is already drawn, with `look`.
    void draw(PanelContext& c, const ImageRect& image, const ImageRect& seen, const DisplayLook& look, const FrameBudget& pace);
    // Names what draw() has drawn; after everything that dims the image.
    void draw_names(const ImageRect& seen) const;

private:
    // Rectangle of an image in a texture.
    struct Part {
        GLuint texture = 0;
        float u = 1, v0 = 0, v1 = 1;
        float aspect = 0; // of the image; 0: same as the live one
    };
    void update_difference(PanelContext& c, const ComparedSide& a, const ComparedSide& b);
    void update(PanelContext& c, const ComparedSide& a, const ComparedSide& b, const DisplayLook& look, const FrameBudget& pace);
    void upload_sides(const PanelContext& c, const ComparedSide& a, const ComparedSide& b);
    void draw_part(const Part& part, const ImageRect& image, const ImageRect& clip) const;
    void draw_wipe(PanelContext& c, const ComparedSide& a, const ComparedSide& b, const ImageRect& image, const ImageRect& seen);

    DisplayPass pass_; // for both sides, A above B, or for the difference
    std::optional<DisplayShader> shader_;
    bool shader_changed_ = false, drawn_ = false;
    DisplayLook look_;
    // The inputs of the last upload.
    struct Shown {
        Comparison::Mode mode = Comparison::Mode::off;
        FramePtr a, b; // of snapshots; null for the live image
        ImageMix mix_a, mix_b;
        const Difference* difference = nullptr;
        bool operator==(const Shown&) const = default;
    } shown_;
    Part parts_[2];
    std::string left_name_, right_name_; // right: of a wipe
    AsyncQuery<DifferenceInput, std::shared_ptr<const Difference>> difference_;
    std::shared_ptr<const Difference> result_;
};

} // namespace blush
