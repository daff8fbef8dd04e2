// A mesh of any size for benchmark scenes.
#pragma once

#include "scene/scene.h"

namespace blush::bench {

// A grid of n x n squares over [-1, 1]^2.
Geometry net(uint32_t n);

} // namespace blush::bench
