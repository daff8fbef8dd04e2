// Detects light that the path tracer cannot find: neither NEE nor BSDF sampling finds a light of zero size through a delta lobe
// (Veach 1997, section 8.3.2: paths of the form L D S+ ...). It is missing from the image and from its error estimate.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace blush {

// User message about the missing light and how to get it back; empty if all light can be found. `used`: the materials of all
// rendered objects, each once or more. Panes that pass light straight through hide nothing (thin_transmission.h).
std::string missing_light(const Scene& scene, const std::vector<Id<Material>>& used);

} // namespace blush
