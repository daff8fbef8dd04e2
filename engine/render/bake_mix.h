// The light mix written into the lights themselves.
#pragma once

#include "scene/edit.h"

namespace blush {

// One edit after which lights, materials and environment shine as the channels of the mix have it, and there are no channels any more: the
// image stays as it is. Lights and materials that several groups share with different gains become one for each.
BakeMix bake_mix(const Scene& scene);

} // namespace blush
