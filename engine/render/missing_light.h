// Light that no strategy can find: a unidirectional path tracer neither samples nor hits a light without size by way of a delta lobe
// (Veach 1997, section 8.3.2: paths of the form L D S+ ...). It is missing from the picture and from the estimate of its error.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace blush {

// One sentence for the user about the light that is missing and how to get it back; empty where all light can be found. `used`: the materials of all
// objects that rays meet, each once or more. Panes that light passes straight on hide nothing (thin_transmission.h).
std::string missing_light(const Scene& scene, const std::vector<Id<Material>>& used);

} // namespace blush
