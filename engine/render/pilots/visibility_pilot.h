// Pilot of learned visibility: traces a part of the image and records which shadow rays arrive.
#pragma once

#include "core/parallel.h"
#include "render/kernels/kernel.h"
#include "render/lights/light_visibility.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace blush {

// Renders some tiles, spread over the film (pilot_tiles.h), and learns from their shadow rays. Its seed differs from that of the image,
// so what it learns does not depend on the image's samples. It is the same for any number of threads and any instruction set.
//
// `context` as for the film at full resolution, except its seed and groups, without learned visibility; its scene has a light tree.
// `scratch`: one per worker, allocated if needed. Empty if `wanted` returned false.
std::optional<LightVisibility> learn_light_visibility(KernelContext context, const Kernel& kernel, const Workers& workers,
                                                      std::vector<std::unique_ptr<TileScratch>>& scratch,
                                                      const std::function<bool()>& wanted);

} // namespace blush
