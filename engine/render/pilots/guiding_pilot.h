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

// Traces photons from the lights to the casters of caustics, with the kernel of the scene. They do not depend on the camera, only on the
// number of pixels. Lights without size emit none: no path can find their caustics.
//
// `context` as for the film at full resolution, except its seed and groups, without a learned guide. `scratch`: one per worker, allocated
// if needed. Null if `wanted` returned false.
std::shared_ptr<const CausticPhotons> trace_caustic_photons(KernelContext context, const Kernel& kernel, const Workers& workers,
                                                            std::vector<std::unique_ptr<TileScratch>>& scratch,
                                                            const std::function<bool()>& wanted);

// Learns from them, and from paths from the camera at a low resolution, which say how much other light there is. Arguments and result as
// above. The seeds differ from that of the image, so the results do not depend on the image's samples. They are the same for any number of
// threads and any instruction set.
std::optional<GuidingField> learn_path_guiding(KernelContext context, const CausticPhotons& photons, const Kernel& kernel,
                                               const Workers& workers, std::vector<std::unique_ptr<TileScratch>>& scratch,
                                               const std::function<bool()>& wanted);

} // namespace blush
