// Pilot of learned portals: learns them on a part of the image, and measures what they gain.
#pragma once

#include "core/parallel.h"
#include "render/compile/feature_report.h"
#include "render/kernels/kernel.h"
#include "render/lights/learned_portals.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace blush {

struct PortalPilot {
    LearnedPortals portals;
    std::optional<PilotFigures> figures; // with over without them; empty: too few cells have a portal
    bool operator==(const PortalPilot&) const = default;
};

// Renders some tiles, spread over the film (pilot_tiles.h): once to learn, then with and without what was learned. Its seeds differ from
// that of the image, so the result does not depend on the image's samples. It is the same for any number of threads and any instruction
// set.
//
// `context` as for the film at full resolution, except its seed and groups, without portals; its scene has an environment. `scratch`: one
// per worker, allocated if needed. Empty if `wanted` returned false.
std::optional<PortalPilot> learn_portals(KernelContext context, const Kernel& kernel, const Workers& workers,
                                         std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted);

} // namespace blush
