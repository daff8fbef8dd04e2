// Pilot of path reuse: measures on a part of the image what it gains and costs.
#pragma once

#include "core/parallel.h"
#include "render/compile/feature_report.h"
#include "render/kernels/kernel.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace blush {

// Renders the same samples of some tiles, spread over the film, without and with path reuse in groups of `group_size` pixels. Both
// trace the same paths; only the connections differ. The samples have a seed of their own, so that the result does not depend on
// those of the image, and it is the same for any number of threads and any instruction set.
//
// The error is that of the halves of the samples, which are independent randomisations of the sampler: its square is the variance of
// stratified samples. MSE sums it over the pixels as it is, relMSE divided by the mean of the tile. The mean of a pixel would hide
// fireflies, and count one that path reuse has spread over eight pixels eight times. Work is counted in rays, not in time.
//
// `context` as for the film at full resolution, its seed and groups aside. `scratch`: one per worker, allocated if needed. Empty if
// `wanted` returned false.
std::optional<PilotFigures> measure_path_reuse(const KernelContext& context, const Kernel& kernel, int group_size, const Workers& workers,
                                               std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted);

} // namespace blush
