// What the tests of the pilots share: the line of the feature report that a pilot decides, and images in several ranges of samples.
#pragma once

#include "render/renderer.h"

#include <algorithm>
#include <cstdio>
#include <gtest/gtest.h>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace blush::test {

inline FeatureUse feature_line(Renderer& renderer, std::string_view name) {
    const auto report = renderer.feature_report();
    const auto found = std::ranges::find(*report, name, &FeatureUse::name);
    return found == report->end() ? FeatureUse{} : *found;
}

// After the pilot, if there is one.
inline FeatureUse decided_line(const Scene& scene, const RenderSettings& settings, std::string_view name, unsigned threads = 2) {
    Renderer renderer({.threads = threads});
    renderer.update(scene, settings);
    EXPECT_TRUE(renderer.decide());
    return feature_line(renderer, name);
}

// Samples [first, first + count) of all parts in this order.
inline Frame rendered_in_parts(const Scene& scene, const RenderSettings& settings, std::initializer_list<std::pair<int64_t, int64_t>> parts,
                               unsigned threads = 2) {
    Renderer renderer({.threads = threads});
    renderer.update(scene, settings);
    for (const auto& [first, count] : parts) EXPECT_TRUE(renderer.render(first, count));
    return renderer.resolve();
}

// The log of a path selects the lights that the image selects.
inline void expect_log_follows_image(const Scene& scene, const RenderSettings& settings) {
    const Frame frame = rendered_in_parts(scene, settings, {{5, 1}});
    for (const auto& [x, y] : {std::pair{10, 20}, {30, 42}, {40, 43}, {50, 44}, {70, 10}}) {
        const std::string log = trace_sample(scene, settings, x, y, 5);
        float red = -1;
        std::sscanf(log.c_str() + log.rfind("radiance ("), "radiance (%f", &red);
        EXPECT_NEAR(red, frame.rgba[4 * size_t(y * frame.width + x)], 5e-6f * red) << log;
    }
}

} // namespace blush::test
