// The options of `blush render`, which the window and every command that renders take too: one parser, one struct.
#pragma once

#include "app/scene_overrides.h"
#include "core/result.h"
#include "scene/render_settings.h"
#include "scene/view_settings.h"

namespace CLI {
class App;
}

namespace blush {

struct RenderOptions {
    RenderSettings settings;
    ViewSettings view;
    SceneOverrides overrides;
    bool size_given = false, spp_given = false, samples_given = false;
};

// Text that makes no sense ends parsing with CLI::ValidationError.
void add_render_options(CLI::App& app, RenderOptions& options);

// The settings that the options together ask for: a time or error limit alone lifts the default limit on samples.
// Errors: options that contradict each other, numbers out of range (validate.h).
Result<RenderSettings> settings_of(const RenderOptions& options);

} // namespace blush
