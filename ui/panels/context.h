// What a panel sees and may do.
#pragma once

#include "color/color_management.h"
#include "io/displayed.h"
#include "render/carried_mix.h"
#include "render/light_groups.h"
#include "render/render_session.h"
#include "scene/document.h"
#include "ui/shown_picture.h"
#include "ui/ui_state.h"
#include "ui/waveform_sheet.h"

#include <functional>

namespace blush {

struct PanelContext {
    Document& document;
    UiState& ui;
    const ColorManagement& color;
    FramePtr frame; // the newest; null before the first
    SessionStatus status;
    // The size that the image has at full resolution.
    int render_width = 0, render_height = 0;
    DenoisedPtr denoised = {};         // of the frame's image, if any
    std::string denoiser_problem = {}; // why nothing can be denoised; empty: it can
    const Ledger* window_ledger = nullptr; // of what the window makes itself; null: nothing
    const Mixing* mixing = nullptr;        // what makes the frame's groups the picture of the scene as it is now; null: nothing does

    float metered_ev = 0; // of the frame, by the auto exposure; 0 without
    WaveformTextures waveforms = {};                                         // of the scopes
    std::function<ImTextureID(const std::string& file)> file_thumbnail = {}; // a texture; 0: there is none

    // How the picture is looked at, with auto exposure settled.
    ViewSettings shown_view() const { return settled(project().view, metered_ev); }
    bool has_picture() const { return frame && frame->width > 0; }
    ShownPicture shown_picture() const { return {frame, denoised, mix_of(ui.denoise, denoised != nullptr), shown_view(), &color}; }
    const Project& project() const { return document.project(); }
    const Scene& scene() const { return document.project().scene; }
    // An edit that the document refuses becomes a toast.
    bool apply(const Edit& edit, Gesture gesture = no_gesture) { return apply({&edit, 1}, label(edit, project()), gesture); }
    // Several as one step of the history; all or none. Channels of the light mix follow the names of their groups.
    bool apply(std::span<const Edit> edits, const std::string& label, Gesture gesture = no_gesture) {
        std::vector<Edit> all(edits.begin(), edits.end());
        if (std::optional<LightMix> mix = carried_mix(project(), edits)) all.push_back(SetMix{*std::move(mix)});
        return accepted(document.apply(all, label, gesture));
    }

private:
    bool accepted(const Result<void>& done) {
        if (!done) ui.toasts.fail(done.error().text());
        return bool(done);
    }
};

} // namespace blush
