// Pilot of path guiding: learns from photons where caustics arrive.
#pragma once

#include "core/parallel.h"
#include "render/compile/feature_report.h"
#include "render/kernels/kernel.h"
#include "render/lights/guiding_field.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace blush {

// Traces photons from the lights to the casters of caustics, with the kernel of the scene, and paths from the camera at a low resolution,
// which say how much other light there is. The seeds differ from that of the image, so the result does not depend on the image's samples.
// It is the same for any number of threads and any instruction set. Lights without size emit none: no path can find their caustics.
//
// `context` as for the film at full resolution, except its seed and groups, without a learned guide. `scratch`: one per worker, allocated
// if needed. Empty if `wanted` returned false.
std::optional<GuidingField> learn_path_guiding(KernelContext context, const Kernel& kernel, const Workers& workers,
                                               std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted);

} // namespace blush
