// The options of `blush render`, which the window and every command that renders take too: one parser, one struct.
#pragma once

#include "app/scene_overrides.h"
#include "core/result.h"
#include "render/denoiser.h"
#include "scene/render_settings.h"
#include "scene/view_settings.h"

#include <optional>

namespace CLI {
class App;
}

namespace blush {

struct RenderOptions {
    RenderSettings settings = recommended_settings();
    ViewSettings view;
    SceneOverrides overrides;
    std::optional<DenoiseQuality> denoise; // empty: off
    std::optional<PixelRect> region;       // of a picture of the size asked for; empty: all of it
    bool width_given = false, height_given = false; // by --size; a side that is not follows the camera's aspect
    bool size_given = false, spp_given = false, samples_given = false, adaptive_given = false, reuse_given = false;
};

// Text that makes no sense ends parsing with CLI::ValidationError.
void add_render_options(CLI::App& app, RenderOptions& options);
// Of those, how a picture is shown: --exposure, --view, --look, --display and their like.
void add_view_options(CLI::App& app, ViewSettings& view);

// The size of a picture for a camera of that aspect (width over height; 0: not known): what --size does not say follows from what it says, or
// from the width that there is without it.
void follow_aspect(RenderOptions& options, float aspect);

// The settings that the options together ask for: a time or error limit alone lifts the default limit on samples, and named samples are not
// spread adaptively.
// Errors: options that contradict each other, numbers out of range (validate.h).
Result<RenderSettings> settings_of(const RenderOptions& options);

} // namespace blush
