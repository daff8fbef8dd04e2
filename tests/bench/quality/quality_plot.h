// Chart of the case "quality".
#pragma once

#include "measure/plot/plot.h"
#include "tests/bench/bench.h"

namespace blush::bench {

// FLIP over milliseconds after an edit, from the JSON of run_quality: one curve for each scene and kind of image, the mean over
// the edits.
Plot quality_plot(const Json& quality);

} // namespace blush::bench
