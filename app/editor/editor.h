// The interactive editor: owns window, document, session and panels.
#pragma once

#include "app/common/scene_overrides.h"
#include "scene/render_settings.h"
#include "scene/view_settings.h"

#include <filesystem>

namespace blush {

struct EditorOptions {
    std::filesystem::path assets;      // folder with scenes/, ocio/ and fonts/
    std::filesystem::path weights;     // folder with the denoiser's weights
    std::filesystem::path scene;       // empty: the card-and-mug scene in `assets`
    std::filesystem::path ocio_config; // empty: see ColorManagement::load
    SceneOverrides overrides;          // only for the scene given here, not for those opened later
    RenderSettings render;
    ViewSettings view;
    // Settings from the command line override those saved with the scene.
    bool settings_given = false, view_given = false;
    bool exposure_given = false; // exposure set on the command line: no metering when the scene opens
    bool denoise = false;        // start with the denoised image
    bool follow_viewport = true; // render at the viewport's size; false: render.width x render.height, from `--size`
    unsigned threads = 0;        // 0: one per core
};

// Runs until the window is closed. Returns the exit code: 0, or 1 after one line on stderr, for example without a display.
int run_editor(const EditorOptions& options);

} // namespace blush
