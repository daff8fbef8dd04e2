// Pilot of light paths: finds how many of them an image is worth.
#pragma once

#include "core/parallel.h"
#include "render/compile/feature_report.h"
#include "render/integrator/light_path_emission.h"
#include "render/kernels/kernel.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace blush {

struct LightPathPilot {
    LightPathEmission emission;               // of all lights
    float share = 0;                          // light paths for each camera path: 0, 1/8, ... 8
    std::optional<PilotFigures> figures = {}; // at that share; at 1/8 if it is 0. Empty: no path that others find reaches the image
    LightPathEmission zero_size = {};         // of lights without size alone; empty: none of them reaches a caster
    float zero_size_share = 0;                // at least 1/8 if there are some
    double work = 0, zero_size_work = 0;      // rays of a light path of all lights, of those without size (path_work)
};

// Emission that smooth edges refine in an image (edge_samples.h).
struct RefinedEmission {
    const Kernel& kernel; // that renders it, without light paths
    int longest_chain;    // delta lobes between camera and emission
};

// Traces light paths and camera paths at a low resolution and chooses the share with the smallest variance x work. The second moment of
// light that light paths can carry is measured by these paths for all shares at once: where the camera's strategies have the density `r`
// times that of light paths, the moment of their combination is that of f^2 / (r + share) (balance heuristic, Veach 1997, 9.2). So it is
// also known where no path of the camera has found the light. The rest is measured by the camera's paths. What light paths alone
// find, of lights without size by a delta lobe, is measured apart.
//
// The noise of emission that smooth edges refine does not count: they take it away. `refined`: empty if the image has none.
//
// `scene_sphere` contains all surfaces; other arguments and the result as learn_path_guiding(), with what was learned before.
std::optional<LightPathPilot> measure_light_paths(KernelContext context, const CasterSphere& scene_sphere, const Kernel& kernel,
                                                  const std::optional<RefinedEmission>& refined, const Workers& workers,
                                                  std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted);

} // namespace blush
