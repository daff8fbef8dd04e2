// Images of another renderer in the case "quality".
#pragma once

#include "tests/bench/bench.h"

namespace blush {
class ColorManagement;
}

namespace blush::bench {

// A row like those of run_quality for the images that a script wrote (cycles_images.py), measured against that renderer's own
// converged image. `file`: its JSON; images are beside it. Throws std::runtime_error if a file cannot be read.
Json peer_row(const std::filesystem::path& file, const ColorManagement& color);

} // namespace blush::bench
