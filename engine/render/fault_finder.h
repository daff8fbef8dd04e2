// Why a sample is no sound radiance.
#pragma once

#include "render/health.h"
#include "render/replay.h"

#include <optional>

namespace blush {

// The first thing that is wrong at a vertex of a path that was sound until there.
std::optional<Fault> fault_at(const ReplayedVertex& vertex, const SceneTables& scene);

// Traces the sample again and returns the first thing that is wrong in it. Only for samples that the film refuses. `scratch` is
// overwritten. To be called from within Workers::run or for_each.
Fault find_fault(const KernelContext& context, int x, int y, int64_t sample, TileScratch& scratch);

} // namespace blush
