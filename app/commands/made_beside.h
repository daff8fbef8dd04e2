// Features that a command uses in addition to the renderer, as lines of the feature report.
#pragma once

#include "render/denoiser.h"
#include "render/ledger.h"

#include <optional>

namespace blush {

struct MadeBeside {
    bool display = false; // view transform used
    std::optional<DenoiseQuality> denoiser;
    std::optional<double> display_seconds, denoiser_seconds; // measured start-up times; of the fast network
};
// The renderer's lines, then these.
Ledger with_made_beside(const Ledger& renderer, const MadeBeside& made);

// Measures the start-up of the default view's processor and of the denoiser's fast network with one pixel, to show what their
// absence saves. No time if one fails.
MadeBeside measure_made_beside(unsigned threads);

} // namespace blush
