// What the tests of the strategies for caustics share: lights, and means over images that are rendered with some of the strategies.
#pragma once

#include "tests/render/pilots/pilot_checks.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/images.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace blush::test {

inline Light caustic_light(Light::Kind kind, float intensity, float radius = 0) {
    Light light;
    light.kind = kind;
    light.intensity = intensity;
    light.radius = radius;
    return light;
}

// Regions of w x h pixels: means over independent images, as one light path adds to many pixels. Calls check(renderer) for each.
template <class Check> std::vector<Measured> image_regions(const Scene& scene, RenderSettings settings, const CausticOptions& strategies,
                                                           int images, uint32_t first_seed, int w, int h, const Check& check) {
    BlockMoments moments;
    for (int k = 0; k < images; ++k) {
        settings.seed = first_seed + uint32_t(k);
        Renderer renderer({.threads = 2, .caustics = strategies});
        renderer.update(scene, settings);
        renderer.render(0, settings.spp);
        check(renderer);
        moments.add(image_of(renderer).blocks(w, h));
    }
    return moments.measured();
}

// Nine blocks of the image.
template <class Check> std::vector<Measured> image_blocks(const Scene& scene, const RenderSettings& settings,
                                                          const CausticOptions& strategies, int images, uint32_t first_seed,
                                                          const Check& check) {
    return image_regions(scene, settings, strategies, images, first_seed, settings.width / 3, settings.height / 3, check);
}

// The same; expects the feature of this name to be used or not.
inline std::vector<Measured> caustic_blocks(const Scene& scene, const RenderSettings& settings, const CausticOptions& strategies,
                                            std::string_view feature, bool used, int images, uint32_t first_seed) {
    return image_blocks(scene, settings, strategies, images, first_seed,
                        [&](Renderer& renderer) { EXPECT_EQ(feature_line(renderer, feature).used, used); });
}

} // namespace blush::test
