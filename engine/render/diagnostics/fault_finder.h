// Finds the cause of a sample with invalid radiance.
#pragma once

#include "render/diagnostics/health.h"
#include "render/diagnostics/replay.h"

#include <optional>

namespace blush {

// Returns the first invalid value at a vertex of a path that was valid before.
std::optional<Fault> fault_at(const ReplayedVertex& vertex, const SceneTables& scene);

// Traces the sample again and returns its first invalid value. Only for samples that the film rejects. `scratch` is overwritten.
// Call it from within Workers::run or for_each.
Fault find_fault(const KernelContext& context, int x, int y, int64_t sample, TileScratch& scratch);

} // namespace blush
