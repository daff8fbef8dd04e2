// The interactive editor: owns window, document, session and panels.
#pragma once

#include "app/scene_overrides.h"
#include "scene/render_settings.h"
#include "scene/view_settings.h"

#include <filesystem>

namespace blush {

struct EditorOptions {
    std::filesystem::path assets;      // folder that holds scenes/, ocio/ and fonts/
    std::filesystem::path weights;     // folder with the denoiser's
    std::filesystem::path scene;       // empty: the card-and-mug scene in `assets`
    std::filesystem::path ocio_config; // empty: as ColorManagement::load decides
    SceneOverrides overrides;          // of the scene given here, not of those opened later
    RenderSettings render;
    ViewSettings view;
    // Named on the command line, they win over those that were saved with the scene.
    bool settings_given = false, view_given = false;
    bool exposure_given = false; // by the command line: the picture is not metered when it opens
    bool denoise = false;        // begin with the denoised picture
    bool follow_viewport = true; // the image has the viewport's size; false: render.width x render.height, as `--size` asks
    unsigned threads = 0;        // 0: one per core
};

// Runs until the window is closed. Returns the process's exit code: 0, or 1 after one line on stderr, as without a display.
int run_editor(const EditorOptions& options);

} // namespace blush
