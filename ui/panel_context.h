// PanelContext: the state that a panel reads, and the edits that it can make.
#pragma once

#include "color/color_management.h"
#include "io/image/display_image.h"
#include "render/light_mix/light_groups.h"
#include "render/light_mix/rename_mix_channels.h"
#include "render/session/render_session.h"
#include "scene/document/document.h"
#include "ui/views/shown_image.h"
#include "ui/widgets/waveform_sheet.h"
#include "ui/window/ui_state.h"

#include <functional>

namespace blush {

struct PanelContext {
    Document& document;
    UiState& ui;
    const ColorManagement& color;
    FramePtr frame; // the newest; null before the first
    SessionStatus status;
    // Resolution of the full-size image.
    int render_width = 0, render_height = 0;
    DenoisedPtr denoised = {};                      // of the frame's image; null: none
    std::string denoiser_problem = {};              // why denoising is not possible; empty: it is possible
    const FeatureReport* window_features = nullptr; // features of the window itself; null: none
    const Mixing* mixing = nullptr;                 // gains that turn the frame's light groups into the current scene's image; null: none

    float metered_ev = 0;                                                    // result of auto exposure for the frame; 0 if it is off
    WaveformTextures waveforms = {};                                         // of the scopes
    ImTextureID strategies = {};                                             // images of the Strategies panel; 0: none
    ImTextureID integrators = {};                                            // images of the Integrators panel; 0: none
    std::function<ImTextureID(const std::string& file)> file_thumbnail = {}; // returns a texture; 0: no thumbnail

    // The view settings, with auto exposure applied.
    ViewSettings shown_view() const { return settled(project().view, metered_ev); }
    bool has_image() const { return frame && frame->width > 0; }
    ShownImage shown_image() const { return {frame, denoised, mix_of(ui.denoise, denoised != nullptr), shown_view(), &color}; }
    const Project& project() const { return document.project(); }
    const Scene& scene() const { return document.project().scene; }
    // Applies an edit. If the document refuses it, an error toast is shown.
    bool apply(const Edit& edit, Gesture gesture = no_gesture) { return apply({&edit, 1}, label(edit, project()), gesture); }
    // Applies several edits as one undo step; all or none. Channels of the light mix follow renamed groups.
    bool apply(std::span<const Edit> edits, const std::string& label, Gesture gesture = no_gesture) {
        std::vector<Edit> all(edits.begin(), edits.end());
        if (std::optional<LightMix> mix = rename_mix_channels(project(), edits)) all.push_back(SetMix{*std::move(mix)});
        return accepted(document.apply(all, label, gesture));
    }

private:
    bool accepted(const Result<void>& done) {
        if (!done) ui.toasts.fail(done.error().text());
        return bool(done);
    }
};

} // namespace blush
