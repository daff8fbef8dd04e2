// Pilot of path reuse: measures gain and cost of path reuse on a part of the image.
#pragma once

#include "core/parallel.h"
#include "render/compile/feature_report.h"
#include "render/kernels/kernel.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace blush {

// Renders some tiles, spread over the film, several times with the same samples: without path reuse, and with groups of each size
// (automatic_group_sizes). These renders trace the same paths; only the connections differ. Their seed differs from that of the image,
// so the result does not depend on the image's samples. It is the same for any number of threads and any instruction set. Returns the
// figures of the size with the lowest cost.
//
// Errors as in variant_comparison.h, relative to the mean of a tile: that of a pixel would count a firefly that path reuse has spread over
// eight pixels eight times. Cost is counted in rays, not in time.
//
// `context` as for the film at full resolution, except its seed and groups. `scratch`: one per worker, allocated if needed. Empty if
// `wanted` returned false.
std::optional<PilotFigures> measure_path_reuse(const KernelContext& context, const Kernel& kernel, const Workers& workers,
                                               std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted);

} // namespace blush
