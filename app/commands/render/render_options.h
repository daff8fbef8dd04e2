// The options of `blush render`, also used by the window and all other commands that render: one parser, one struct.
#pragma once

#include "app/common/scene_overrides.h"
#include "core/result.h"
#include "render/comparison/comparison_integrator.h"
#include "render/denoise/denoiser.h"
#include "scene/render_settings.h"
#include "scene/view_settings.h"

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace blush {

struct RenderOptions {
    RenderSettings settings = recommended_settings();
    ViewSettings view;
    SceneOverrides overrides;
    ComparisonIntegrator integrator;                // for comparison
    std::optional<DenoiseQuality> denoise;          // empty: off
    std::optional<PixelRect> region;                // of an image of the requested size; empty: all of it
    std::string allocation;                         // file of adaptive sampling for a part; empty: none
    bool width_given = false, height_given = false; // by --size; a missing side follows the camera's aspect ratio
    bool size_given = false, spp_given = false, samples_given = false, adaptive_given = false, reuse_given = false;
};

// Invalid text ends parsing with CLI::ValidationError.
void add_render_options(CLI::App& app, RenderOptions& options);
// Apart, since only commands that compare images take it.
void add_integrator_option(CLI::App& app, RenderOptions& options);
// Those of them that say which image it is and what light it has: for commands that render no image but probe places of one.
void add_probe_options(CLI::App& app, RenderOptions& options);
// The display options among them: --exposure, --view, --look, --display etc.
void add_view_options(CLI::App& app, ViewSettings& view);

// Completes the size for a camera of this aspect ratio (width / height; 0: unknown): a side missing in --size is computed from
// the other; without --size, the height from the default width.
void follow_aspect(RenderOptions& options, float aspect);

// Combines the options: a time or error limit without --spp removes the default sample limit; --samples disables adaptive
// sampling unless it is given; then samples beyond the pilot need an allocation. Errors: contradicting options, numbers out of range
// (validate.h).
Result<RenderSettings> settings_of(const RenderOptions& options);

} // namespace blush
