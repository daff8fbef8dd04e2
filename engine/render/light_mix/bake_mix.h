// Bakes the light mix into the lights themselves.
#pragma once

#include "scene/document/edit.h"

namespace blush {

// Returns one edit that scales lights, materials and the environment by the channels of the mix and removes the channels; the
// image does not change. Lights and materials that several groups share with different gains are split into one for each gain.
BakeMix bake_mix(const Scene& scene);

} // namespace blush
