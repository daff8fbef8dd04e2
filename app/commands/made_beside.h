// What a command makes beside the renderer, as lines of the ledger.
#pragma once

#include "render/denoiser.h"
#include "render/ledger.h"

#include <optional>

namespace blush {

struct MadeBeside {
    bool display = false; // a view transform
    std::optional<DenoiseQuality> denoiser;
    std::optional<double> display_seconds, denoiser_seconds; // that they took, or would have: of the fast network
};
// The renderer's lines, then these.
Ledger with_made_beside(const Ledger& renderer, const MadeBeside& made);

// Makes the default view's processor and the denoiser's fast network for one pixel, to see what leaving them out saves. What cannot be
// made has no figure.
MadeBeside measure_made_beside(unsigned threads);

} // namespace blush
