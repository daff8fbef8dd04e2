// Two pictures in the place of one: a wipe between them, either by turns, or their difference. Draws over the viewport's picture.
#pragma once

#include "ui/background_answer.h"
#include "ui/difference.h"
#include "ui/display_pass.h"
#include "ui/frame_pace.h"
#include "ui/gizmo.h"
#include "ui/panels/context.h"

#include <optional>
#include <string>

namespace blush {

// One of the two: a snapshot's pictures, or the live ones.
struct ComparedSide {
    uint64_t id = live_image;
    std::string label;
    Pictures pictures;
};
// Null frames where there is no such picture.
ComparedSide compared_side(const PanelContext& c, uint64_t id);

class CompareView {
public:
    void set_shader(const DisplayShader& shader);
    // `image` is where the whole picture lies, `seen` what of it is in the window; the live picture is there already, drawn with `look`.
    void draw(PanelContext& c, const ImageRect& image, const ImageRect& seen, const DisplayLook& look, const FramePace& pace);

private:
    // Where in a texture a picture lies.
    struct Part {
        GLuint texture = 0;
        float u = 1, v0 = 0, v1 = 1;
        float aspect = 0; // of the picture; 0: that of the live one
    };
    void ask_difference(PanelContext& c, const ComparedSide& a, const ComparedSide& b);
    void update(PanelContext& c, const ComparedSide& a, const ComparedSide& b, const DisplayLook& look, const FramePace& pace);
    void upload_sides(const PanelContext& c, const ComparedSide& a, const ComparedSide& b);
    void draw_part(const Part& part, const ImageRect& image, const ImageRect& clip) const;
    void draw_wipe(PanelContext& c, const ComparedSide& a, const ComparedSide& b, const ImageRect& image, const ImageRect& seen);

    DisplayPass pass_; // of both sides, A above B, or of the difference
    std::optional<DisplayShader> shader_;
    bool shader_changed_ = false, drawn_ = false;
    DisplayLook look_;
    // What it was last given.
    struct Shown {
        Comparison::Mode mode = Comparison::Mode::off;
        FramePtr a, b; // of snapshots; null for the live one
        PictureMix mix_a, mix_b;
        const Difference* difference = nullptr;
        bool operator==(const Shown&) const = default;
    } shown_;
    Part parts_[2];
    BackgroundAnswer<DifferenceQuestion, std::shared_ptr<const Difference>> difference_;
    std::shared_ptr<const Difference> answer_;
};

} // namespace blush
