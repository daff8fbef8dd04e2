// Images of a scene by one strategy, whose means are compared.
#pragma once

#include "tests/render/rendered_image.h"

#include <vector>

namespace blush::test {

// Blocks of 16 x 16 pixels of an image of 32 x 32, after at most three bounces. Each strategy and size of reuse groups has its own seed.
inline std::vector<Measured> shot(const Scene& scene, Strategy strategy, int64_t spp, int reuse = 1) {
    RenderSettings settings = settings_for(32, 32, spp);
    settings.strategy = strategy;
    settings.seed = 1 + uint32_t(strategy) + uint32_t(reuse);
    settings.max_bounces = 3;
    settings.reuse = reuse;
    return render(scene, settings).blocks(16, 16);
}

} // namespace blush::test
