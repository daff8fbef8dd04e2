// Detects light that the path tracer cannot find: neither NEE nor BSDF sampling finds a light of zero size through a delta lobe
// (Veach 1997, section 8.3.2: paths of the form L S+ D ...). Light paths find it, but for what the camera sees through delta lobes
// (L S+ D S+ E), and manifold sampling most of that, on surfaces that do not transmit light. The rest is missing from the image and from
// its error estimate.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace blush {

// Surfaces of rendered objects that are smooth, and others that smooth ones send light to.
struct SmoothSurfaces {
    bool mirror = false; // all of them reflect, and smooth clear coats
    bool glass = false;  // some also transmit; not panes, which pass light straight through (thin_transmission.h)
    // Some transmit and are not smooth, or not only: rough glass, translucent and half-clear ones. Chains of manifold sampling do not
    // begin there.
    bool rough_transmission = false;
};
// `used`: the materials of all rendered objects, each once or more. Without those that are smooth by a texture (smoothness.h).
SmoothSurfaces smooth_surfaces(const Scene& scene, const std::vector<Id<Material>>& used);
// Number of enabled, visible lights without a size, which no ray hits: point and spot lights without radius, suns without angle.
// `nodes`: those with lights (expanded_lights.h).
int count_zero_size_lights(const Scene& scene, const std::vector<Id<Node>>& nodes);
// What finds such light.
enum class CausticFinders { none, light_paths, manifolds, light_paths_and_manifolds };
// User message about the missing light and how to get it back; empty if all light can be found. `nodes`: those with lights
// (expanded_lights.h).
std::string missing_light(const Scene& scene, const std::vector<Id<Node>>& nodes, const SmoothSurfaces& surfaces, CausticFinders finders);

} // namespace blush
