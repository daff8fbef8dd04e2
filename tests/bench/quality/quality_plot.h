// Chart of the case "quality".
#pragma once

#include "tests/bench/bench.h"

#include <string>

namespace blush::bench {

// SVG with a chart of each scene: FLIP over milliseconds after the edit, mean over kinds of edits, of raw and denoised images and of
// peers' images.
std::string quality_chart(const Json& quality);

} // namespace blush::bench
