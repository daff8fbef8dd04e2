// Features that a command uses in addition to the renderer, as lines of the feature report.
#pragma once

#include "render/compile/feature_report.h"
#include "render/denoise/denoiser.h"

#include <optional>

namespace blush {

// If this process has loaded OpenImageIO.
FeatureUse image_library_use();

struct CommandFeatures {
    FeatureUse image_library = image_library_use();
    bool display = false; // view transform used
    std::optional<DenoiseQuality> denoiser;
    std::optional<double> display_seconds, denoiser_seconds; // measured start-up times; of the fast network
};
// The renderer's lines, then these.
FeatureReport with_command_features(const FeatureReport& renderer, const CommandFeatures& made);

// Measures the start-up of OpenImageIO, of the default view's processor and of the denoiser's fast network with one pixel, to show
// what their absence saves. No time if one fails.
CommandFeatures measure_command_features(unsigned threads);

} // namespace blush
