// First surfaces of camera rays, for what is estimated beside the kernels.
#pragma once

#include "render/kernels/kernel.h"

#include <cstdint>

namespace blush {

// Traces the rays in tile.paths[0] to the first surfaces with a bit of `mask` (accel_scene.h), into tile.hits. Blended surfaces stop them
// by chance, with the kernels' random numbers.
void trace_first_surfaces(const KernelContext& context, uint32_t mask, TileScratch& tile);

} // namespace blush
