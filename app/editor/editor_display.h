// Display state of the editor: the display shader, the metered exposure, and their feature report.
#pragma once

#include "color/color_management.h"
#include "render/session/render_session.h"
#include "ui/snapshots/snapshot_strip.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/image_sheet.h"
#include "ui/window/toasts.h"

#include <array>
#include <filesystem>

namespace blush {

class EditorDisplay {
public:
    EditorDisplay(const ColorManagement& color, std::filesystem::path weights) : color_(color), weights_(std::move(weights)) {}

    // Updates the shader of viewport, strip and the sheets of panels if the view transform has changed. No shader before the first frame.
    void update_shader(const ViewSettings& view, const FramePtr& frame, Viewport& viewport, ThumbnailSheet& thumbnails, Toasts& toasts);
    // What the Strategies and the Integrators panel compare as textures, 0: nothing; they request another frame while images are not
    // finished.
    ImTextureID strategies(UiState& ui, const ViewSettings& view);
    ImTextureID integrators(UiState& ui, const ViewSettings& view);
    // Meters the frame if auto exposure is on.
    void meter(AutoExposure rule, const FramePtr& frame);
    void update_feature_report(const SessionStatus& status);

    float metered_ev() const { return metered_ev_; } // 0 if auto exposure is off
    const FeatureReport& feature_report() const { return feature_report_; }

private:
    const ColorManagement& color_;
    std::filesystem::path weights_;
    DisplayTransform transform_; // of the current shader
    bool shader_ready_ = false;
    ImageSheet strategies_, integrators_;
    FramePtr metered_;
    AutoExposure metered_by_ = AutoExposure::off;
    float metered_ev_ = 0;
    FeatureUse view_transform_{"display", "view transform", false, "no image yet"};
    FeatureReport feature_report_;
    std::array<bool, denoise_qualities> denoised_with_{};
};

} // namespace blush
