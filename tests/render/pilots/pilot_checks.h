// What the tests of the pilots share: the line of the feature report that a pilot decides, and images in several ranges of samples.
#pragma once

#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/film/film_state.h"
#include "render/integrator/kernel_settings.h"
#include "render/kernels/kernel.h"
#include "render/renderer.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <gtest/gtest.h>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

// What the pilot learns, which is the same for every instruction set and number of threads.
template <class Pilot> auto learned_by_every_kernel(const Scene& scene, const RenderSettings& settings, const Pilot& pilot) {
    RenderScene compiled;
    compiled.update(expand_area_lights(scene), settings, full_plan(), Workers(2));
    const KernelContext context{&compiled.tables(), &compiled.accel(), kernel_settings(settings, settings.width, settings.height)};
    const auto learn = [&](const Kernel& kernel, unsigned threads) {
        const Workers workers(threads);
        std::vector<std::unique_ptr<TileScratch>> scratch(workers.threads());
        return *pilot(context, kernel, workers, scratch, std::function<bool()>());
    };
    auto expected = learn(kernels_of("scalar").back(), 1);
    for (const std::string_view isa : runnable_isas()) {
        const auto kernels = kernels_of(isa);
        const auto smallest = std::ranges::find_if(kernels, [&](const Kernel& k) { return k.features.contains(compiled.features()); });
        for (const unsigned threads : {1u, 3u}) EXPECT_EQ(learn(*smallest, threads), expected) << isa << " " << threads;
    }
    return expected;
}

// The log of a path selects the lights that the image selects.
inline void expect_log_follows_image(const Scene& scene, const RenderSettings& settings) {
    // Without the light of light paths, which belong to no pixel: from the sums of the odd half.
    Renderer renderer({.threads = 2});
    renderer.update(scene, settings);
    ASSERT_TRUE(renderer.render(5, 1));
    const Result<FilmState> film = renderer.save_film(5);
    ASSERT_TRUE(film);
    const LosslessPlane& reds = *film->find("odd.R");
    for (const auto& [x, y] : {std::pair{10, 20}, {30, 42}, {40, 43}, {50, 44}, {70, 10}}) {
        const std::string log = trace_sample(scene, settings, x, y, 5);
        float red = -1;
        std::sscanf(log.c_str() + log.rfind("radiance ("), "radiance (%f", &red);
        EXPECT_NEAR(double(red), reds.sum(size_t(y * settings.width + x)), 5e-6 * double(red)) << log;
    }
}

} // namespace blush::test
