// A scene that tests render with manifold sampling by kernels of their choice, tile by tile.
#pragma once

#include "render/integrator/light_path_emission.h"
#include "render/lights/manifold_seed_table.h"
#include "render/pilots/guiding_pilot.h"
#include "tests/render/integrator/caustic_images.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace blush::test {

class ChainedScene {
public:
    ChainedScene(const Scene& scene, const RenderSettings& settings) : settings_(settings) {
        compiled_.update(expand_area_lights(scene), settings, full_plan(), Workers(1));
        tables = compiled_.tables();
        std::vector<std::unique_ptr<TileScratch>> scratch(1);
        const auto photons =
            trace_caustic_photons(context(tables, 3), kernels_of("scalar").back(), Workers(1), scratch, [] { return true; });
        seeds_ = ManifoldSeedTable::make(photons->chains, tables, Workers(1), {}).value();
        EXPECT_FALSE(seeds_.empty());
        tables.manifolds = seeds_.tables(tables.casters);
        emission = LightPathEmission(tables, compiled_.bounding_sphere(),
                                     [&](int32_t light) { return tables.manifolds.group_of_light[light] >= 0; });
        EXPECT_FALSE(emission.empty());
        tables.guides = {};
        if (!tables.blends) usual_ratio = measured_ratio(); // light vertices are not connected through blended surfaces
    }
    KernelContext context(const SceneTables& scene, uint32_t seed) const {
        return {&scene, &compiled_.accel(), kernel_settings(settings_, float(size), float(size)), seed};
    }
    Features features() const { return compiled_.features(); }
    SceneTables with_vertices() const {
        EXPECT_GT(usual_ratio, 0);
        return with_vertices(usual_ratio);
    }
    SceneTables with_vertices(float ratio) const {
        SceneTables t = tables;
        t.light_vertices = {emission.tables(1), emission.tables(1), ratio, 0.1f};
        return t;
    }
    // Radiance of the samples of an image; with `strategies`, of each that finds it.
    std::unique_ptr<TileScratch> render(const SceneTables& scene, const Kernel& kernel, uint32_t seed, bool strategies = false) const {
        auto tile = std::make_unique<TileScratch>();
        if (strategies) tile->strategies = std::make_unique<StrategyColumns>(false);
        Workers(1).run(
            [&] { kernel.render(context(scene, seed), {.x = 0, .y = 0, .width = size, .height = size, .samples = samples}, *tile); });
        return tile;
    }
    // Means of the quarters of images of different seeds. image(seed): its pixels.
    using Pixels = std::vector<Vec3d>;
    template <class Image> static std::vector<Measured> quarters_of(int images, uint32_t first_seed, const Image& image) {
        BlockMoments moments;
        for (int k = 0; k < images; ++k) {
            const Pixels pixels = image(first_seed + uint32_t(k));
            std::vector<Measured> blocks(4);
            for (int pixel = 0; pixel < size * size; ++pixel) {
                const int x = pixel % size, y = pixel / size;
                Vec3d& mean = blocks[size_t(y / (size / 2) * 2 + x / (size / 2))].mean;
                mean = mean + pixels[size_t(pixel)] * (4.0 / (size * size));
            }
            moments.add(blocks);
        }
        return moments.measured();
    }
    static Pixels pixels_of(const double* r, const double* g, const double* b) {
        Pixels pixels(size_t(size) * size);
        for (size_t slot = 0; slot < size_t(paths); ++slot) {
            Vec3d& pixel = pixels[slot / size_t(samples)];
            pixel = pixel + Vec3d{r[slot], g[slot], b[slot]} * (1.0 / samples);
        }
        return pixels;
    }
    const Kernel& fastest_kernel() const { return choose_kernel(features().with(Feature::light_paths)); }
    std::vector<Measured> quarters(const SceneTables& scene, int images, uint32_t first_seed) const {
        return quarters_of(images, first_seed, [&](uint32_t seed) {
            const auto tile = render(scene, fastest_kernel(), seed);
            return pixels_of(tile->r.data, tile->g.data, tile->b.data);
        });
    }

    // Splats of so many light paths for each sample. They, and the weights, are for `scene.emission.paths` of them.
    Pixels splats(const SceneTables& scene, int light_paths, uint32_t seed) const {
        const Kernel kernel = fastest_kernel();
        const KernelContext of_image = context(scene, seed);
        const auto tile = std::make_unique<TileScratch>();
        Pixels pixels(size_t(size) * size);
        Workers(1).run([&] {
            for (int pass = 0; pass < samples; ++pass) {
                trace_light_path_tile(of_image, kernel, emission, {pass, light_paths, 0, light_paths}, *tile);
                for (const Splat& s : tile->light_paths->splats)
                    pixels[size_t(s.pixel)] = pixels[size_t(s.pixel)] + to_double(s.radiance) * (1.0 / samples);
            }
        });
        return pixels;
    }

    static constexpr int size = 24, samples = 7, paths = size * size * samples;
    SceneTables tables;
    LightPathEmission emission;
    float usual_ratio = 0; // 0: there are no light vertices

private:
    float measured_ratio() const {
        const auto tile = render(with_vertices(1), kernels_of("scalar").back(), 3);
        double sum = 0;
        int count = 0;
        for (int slot = 0; slot < paths; ++slot) {
            if (tile->light_vertices->chain[slot] == 0) continue;
            sum += std::log(double(tile->light_vertices->ratio[slot]));
            ++count;
        }
        return count > 0 ? float(std::exp(sum / count)) : 0;
    }

    RenderSettings settings_;
    RenderScene compiled_;
    ManifoldSeedTable seeds_;
};

} // namespace blush::test
