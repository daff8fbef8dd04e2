// Images of integrators for comparison, as measurements.
#pragma once

#include "render/comparison/comparison_integrator.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <gtest/gtest.h>
#include <memory>
#include <string>

namespace blush::test {

inline std::unique_ptr<Renderer> integrator_renderer(const Scene& scene, const RenderSettings& settings, const std::string& integrator,
                                                     unsigned threads = 2) {
    auto renderer = std::make_unique<Renderer>(RendererOptions{.threads = threads, .integrator = *parse_integrator(integrator)});
    renderer->update(scene, settings);
    return renderer;
}

// After the samples of the settings.
inline std::unique_ptr<Renderer> integrator_render(const Scene& scene, const RenderSettings& settings, const std::string& integrator,
                                                   unsigned threads = 2) {
    auto renderer = integrator_renderer(scene, settings, integrator, threads);
    renderer->render(0, settings.spp);
    return renderer;
}

inline Frame integrator_frame(const Scene& scene, const RenderSettings& settings, const std::string& integrator, unsigned threads = 2) {
    return integrator_render(scene, settings, integrator, threads)->resolve();
}

// The Cornell box has the same bits in one go and in parts, with two threads and with one.
inline void expect_same_bits_in_parts_and_threads(const std::string& integrator) {
    const Scene scene = shipped_scene("cornell");
    const RenderSettings settings = settings_for(40, 40, 4);
    const auto parts = integrator_renderer(scene, settings, integrator);
    parts->render(0, 1);
    parts->render(1, 3);
    const Frame whole = integrator_frame(scene, settings, integrator);
    EXPECT_EQ(parts->resolve().rgba, whole.rgba);
    EXPECT_EQ(integrator_frame(scene, settings, integrator, 1).rgba, whole.rgba);
}

// Means of the whole image over seeds.
inline Measured integrator_mean(const Scene& scene, RenderSettings settings, const std::string& integrator, uint32_t seeds = 16) {
    BlockMoments moments;
    for (settings.seed = 0; settings.seed < seeds; ++settings.seed) {
        const Measured image = image_of(*integrator_render(scene, settings, integrator)).whole();
        moments.add({&image, 1});
    }
    return moments.measured()[0];
}

// Walls that emit 1 nit and reflect half: radiance 1 / (1 - 0.5) everywhere. Seen: the middle of a wall, far from its edges.
inline Scene glowing_walls() {
    Scene scene;
    place(scene, cube(true), emitter(1, 0.5f));
    scene.view = looking({0, 0, 0.9f}, {0, 0, -1}, 0.3f);
    return scene;
}

} // namespace blush::test
