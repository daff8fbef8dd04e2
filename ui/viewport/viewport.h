// The viewport: displays the image and handles the mouse in it (navigation, picking, handles).
#pragma once

#include "core/parallel.h"
#include "render/light_mix/light_groups.h"
#include "ui/gl/display_pass.h"
#include "ui/gl/outline_pass.h"
#include "ui/lights/place_tool.h"
#include "ui/panel_context.h"
#include "ui/snapshots/compare_view.h"
#include "ui/transform/handles.h"
#include "ui/transform/transformer.h"
#include "ui/viewport/image_state.h"
#include "ui/viewport/navigation.h"
#include "ui/viewport/region_backdrop.h"
#include "ui/views/mix_preview.h"
#include "ui/window/frame_budget.h"

namespace blush {

class Viewport {
public:
    // Compiles the shaders that do not depend on the OCIO configuration.
    Result<void> load() { return outline_.load(); }
    Result<void> set_display_shader(const DisplayShader& shader);

    // Fills the current ImGui window and returns the image's rectangle. Continues to draw a new image as long as `pace` has
    // time.
    ImageRect draw(PanelContext& c, const FrameBudget& pace);
    // As draw(), but without interaction and overlays, except for `caption`, which gives the reason.
    ImageRect draw_alone(PanelContext& c, const FrameBudget& pace, const char* caption);
    // The displayed frame; null before the first.
    const FramePtr& shown() const { return shown_frame_; }
    // The gains of its light groups as displayed; empty without groups.
    const Gains& shown_gains() const { return shown_gains_; }
    // True if the images are displayed with these gains.
    bool shows(const ImageMix& mix) const { return shown_frame_ && !is_drawing(state_) && look_.mix == mix; }
    // True while an image is drawn, over several UI frames if it is large.
    bool draws_image() const { return display_.busy(); }
    // True if it temporarily shows a lower resolution, while a light mix is edited.
    bool is_subsampled() const { return is_preview(state_) || shows_preview_; }

private:
    struct WantedImage;
    static WantedImage wanted_image(PanelContext& c);
    ImageInputs image_inputs(const PanelContext& c, const WantedImage& w, const FrameBudget& pace);
    void upload(const PanelContext& c, const WantedImage& w, const ImageStep& step);
    void take_frame(PanelContext& c, const FrameBudget& pace);
    void upload_frame(const FramePtr& shown, const ImageView& view, const Gains& gains, bool background_as_it_is);
    void upload_denoised(const DenoisedPtr& denoised, const Gains& gains);
    void upload_subsampled(const MixPreviewSource& moved, const Gains& gains, int step);
    void draw_texture(const ImageRect& image, const std::optional<ImageRect>& frame) const;
    void draw_image(PanelContext& c, const ImageRect& image, bool outlined, const std::optional<ImageRect>& frame);
    void draw_surroundings(PanelContext& c, const ImageRect& image, const FrameBudget& pace);
    void draw_outline(const PanelContext& c, const ImageRect& image);
    void draw_caption(PanelContext& c, const ImageRect& image) const;
    bool draw_overlays(PanelContext& c, const Projection& projection, const ImageRect& image, bool hovered);
    void navigate(PanelContext& c, const Projection& projection, const ImageRect& image, bool hovered, bool on_handle);
    void handle_requests(PanelContext& c, const NavigationResult& input, const Projection& projection, const ImageRect& image);

    DisplayPass display_;
    OutlinePass outline_;
    CompareView compare_;
    RegionBackdrop region_backdrop_;
    Navigation navigation_;
    bool navigating_ = false; // in the last frame; its edits are one undo step
    Handles handles_;
    Transformer transformer_;
    Gesture exposure_gesture_ = no_gesture;
    PlaceTool place_tool_;

    // The content of the textures, to redraw them only when something has changed.
    FramePtr uploaded_frame_, shown_frame_;
    ImageView uploaded_view_;
    DenoisedPtr uploaded_denoised_;
    Gains uploaded_gains_, shown_gains_; // of raw and denoised image
    ImageState state_ = ImageState::current;
    bool shows_preview_ = false;             // the displayed image is a preview of the mix
    FrameBudget::TimePoint mix_edited_at_{}; // last edit of the mix
    MixPreview preview_;
    std::shared_ptr<std::vector<float>> mixed_, mixed_denoised_; // mixed images, kept to reuse their memory
    Workers workers_{0};                                         // for mixing planes
    DisplayLook look_;
    bool shader_changed_ = false;
    bool drew_display_ = false; // in this UI frame
    struct Outlined {
        FramePtr frame;
        Id<Node> selected;
        bool operator==(const Outlined&) const = default;
    } outlined_;
};

} // namespace blush
