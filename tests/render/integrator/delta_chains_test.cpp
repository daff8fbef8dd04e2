// Delta chains: the same mean as paths that select one lobe at each surface, and the second moment of these; the same bits whatever other
// samples they are traced with, in every instruction set.
#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/film/edges/edge_samples.h"
#include "render/integrator/kernel_settings.h"
#include "tests/render/scenes.h"
#include "tests/support/images.h"
#include "tests/support/statistics.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using statistics::Moments;

constexpr int width = 16, height = 12;
constexpr int at_once = tile_capacity / most_copies;

// The light that the camera sees by delta lobes alone.
struct Emission {
    RenderSettings settings = settings_for(width, height, 1);
    Workers workers{1};
    RenderScene scene;
    SceneTables tables;
    KernelContext context;

    explicit Emission(const Scene& s, SamplerType sampler = SamplerType::random) {
        settings.sampler = sampler;
        scene.update(expand_area_lights(s), settings, full_plan(), workers);
        context = {&scene.tables(), &scene.accel(), kernel_settings(settings, width, height), 7};
        restrict_to_emission(context, tables, longest_highlight_chain);
    }
    template <class Run> void run(const Run& task) {
        workers.run([&] { task(); });
    }
};

Scene before(float background) {
    Scene scene;
    constant_world(scene, background);
    place_sphere_light(scene, {1, 2.5f, 2}, 0.5f, 40);
    scene.view = looking({0, 0.3f, 4}, {0, 0, 0}, 0.5f);
    return scene;
}

Scene glass_ball() {
    Scene scene = before(0.3f);
    place(scene, sphere(false), glass(0, 1.5f));
    return scene;
}
// More lobes than a sample may have chains.
Scene coated_balls() {
    Scene scene = before(0.1f);
    Material coated = glass(0, 1.8f);
    coated.clearcoat = 1;
    for (const float x : {-0.6f, 0.f, 0.6f})
        for (const float z : {-1.f, 0.f, 1.f}) place(scene, sphere(false), coated, at({x, 0, z}, 0.45f));
    place(scene, quad({-3, -2, -2}, {3, -2, -2}, {3, 2, -2}, {-3, 2, -2}), metal(0));
    return scene;
}
Scene dispersive_ball() {
    Scene scene = before(0.3f);
    Material flint = glass(0, 1.6f);
    flint.dispersion = 0.5f;
    place(scene, sphere(false), flint);
    return scene;
}
// Behind a pane and a blended surface; half of the ball is plastic.
Scene through_a_window() {
    Scene scene = before(0.3f);
    Material leaf = lambert(0.6f), half = glass(0, 1.5f);
    leaf.alpha = Material::Alpha::blend;
    leaf.opacity = 0.5f;
    half.transmission = 0.5f;
    place(scene, sphere(false), half);
    place(scene, quad({-2, -2, 1.5f}, {2, -2, 1.5f}, {2, 2, 1.5f}, {-2, 2, 1.5f}), window_glass({0.9f, 0.95f, 1}));
    place(scene, quad({-2, -2, 1.2f}, {0.2f, -2, 1.2f}, {0.2f, 2, 1.2f}, {-2, 2, 1.2f}), leaf);
    return scene;
}

struct Named {
    const char* name;
    Scene scene;
};
std::vector<Named> scenes() {
    return {{"glass ball", glass_ball()},
            {"coated balls", coated_balls()},
            {"dispersive ball", dispersive_ball()},
            {"through a window", through_a_window()}};
}

double luminance_of(const TileScratch& tile, int slot) { return luminance(Vec3d{tile.r[slot], tile.g[slot], tile.b[slot]}); }

TEST(DeltaChains, HaveTheMeanAndTheSecondMomentOfPaths) {
    const auto all = scenes();
    const double alpha = statistics::sidak(statistics::significance, 2 * int64_t(all.size()));
    for (const auto& [name, scene] : all) {
        Emission emission(scene);
        const Kernel& kernel = choose_kernel(emission.scene.features());
        const auto tile = std::make_unique<TileScratch>();
        Moments paths, chains, path_squares, chain_squares; // chain_squares: of paths, as the chains estimate it
        double squares = 0;
        emission.run([&] {
            for (int y = 0; y < height; ++y)
                for (int pass = 0; pass < 32; ++pass) {
                    const TileJob job{.x = 0, .y = y, .width = width, .height = 1, .first_sample = pass * 32, .samples = at_once / width};
                    kernel.render(emission.context, job, *tile);
                    for (int k = 0; k < job.paths(); ++k) {
                        paths.add(luminance_of(*tile, k));
                        path_squares.add(luminance_of(*tile, k) * luminance_of(*tile, k));
                    }
                    KernelContext other = emission.context;
                    other.seed = 8;
                    kernel.trace_chains(other, job, *tile);
                    for (int k = 0; k < job.paths(); ++k) {
                        chains.add(luminance_of(*tile, k));
                        chain_squares.add(tile->chains->path_squares[k]);
                        squares += luminance_of(*tile, k) * luminance_of(*tile, k);
                    }
                }
        });
        EXPECT_TRUE(statistics::same_mean(paths, chains, alpha)) << name;
        EXPECT_TRUE(statistics::same_mean(path_squares, chain_squares, alpha)) << name;
        EXPECT_LT(squares, path_squares.mean * double(path_squares.count)) << name << ": no less noise";
    }
}

// Places that cover lamps, parts of them or none.
HighlightPlaces any_places(const FilterTable& filter) {
    std::vector<HighlightPlace> places;
    for (int y = 0; y < height; y += 2)
        for (int x = 0; x < width; x += 3)
            places.push_back({.x = x + 0.4, .y = y + 0.9, .ax = 0.3, .ay = 0.1, .bx = -0.05, .by = 0.4, .light = 1.0 + x});
    return HighlightPlaces(places, width, height, filter);
}

TEST(DeltaChains, ThatAimAtPlacesHaveTheSameMeanAndSecondMomentOfPaths) {
    const auto all = scenes();
    const double alpha = statistics::sidak(statistics::significance, 2 * int64_t(all.size()));
    for (const auto& [name, scene] : all) {
        Emission emission(scene);
        const Kernel& kernel = choose_kernel(emission.scene.features());
        const HighlightPlaces places = any_places(*emission.context.settings.filter);
        const auto tile = std::make_unique<TileScratch>();
        Moments plain, aimed, plain_squares, aimed_squares;
        int64_t moved = 0;
        emission.run([&] {
            for (int y = 0; y < height; ++y)
                for (int pass = 0; pass < 32; ++pass) {
                    const TileJob job{.x = 0, .y = y, .width = width, .height = 1, .first_sample = pass * 32, .samples = at_once / width};
                    kernel.trace_chains(emission.context, job, *tile);
                    for (int k = 0; k < job.paths(); ++k) {
                        plain.add(luminance_of(*tile, k));
                        plain_squares.add(tile->chains->path_squares[k]);
                    }
                    KernelContext other = emission.context;
                    other.seed = 8;
                    tile->chains->places = &places;
                    kernel.trace_chains(other, job, *tile);
                    tile->chains->places = nullptr;
                    for (int k = 0; k < job.paths(); ++k) {
                        aimed.add(luminance_of(*tile, k));
                        aimed_squares.add(tile->chains->path_squares[k]);
                        moved += tile->chains->weight[k] >= 0;
                    }
                }
        });
        EXPECT_GT(moved, 0) << name;
        EXPECT_LT(moved, aimed.count) << name << ": every pixel has a place";
        EXPECT_TRUE(statistics::same_mean(plain, aimed, alpha)) << name;
        EXPECT_TRUE(statistics::same_mean(plain_squares, aimed_squares, alpha)) << name;
    }
}

// The image of a lamp after four reflections within a ball: a path meets it with all its light, chains with a share.
TEST(DeltaChains, BoundTheLightOfFaintImages) {
    Scene scene;
    place(scene, sphere(false), glass(0, 1.5f));
    place_sphere_light(scene, {1, 3, 2}, 0.3f, 100);
    scene.view = looking({0, 0.5f, 4}, {0, 0, 0}, 0.7f);
    Emission emission(scene);
    const Kernel& kernel = choose_kernel(emission.scene.features());
    const auto tile = std::make_unique<TileScratch>();
    double largest = 0, faint = 0;
    emission.run([&] {
        for (int y = 0; y < height; ++y)
            for (int pass = 0; pass < 64; ++pass) {
                kernel.trace_chains(emission.context, {.y = y, .width = width, .height = 1, .first_sample = pass * 32, .samples = 32},
                                    *tile);
                for (int k = 0; k < at_once; ++k)
                    if (const double l = luminance_of(*tile, k); l > 0) {
                        const double of_path = tile->chains->path_squares[k] / l;
                        largest = std::max(largest, of_path);
                        if (l < of_path / 20) faint = std::max(faint, l);
                    }
            }
    });
    EXPECT_GT(largest, 0);
    EXPECT_GT(faint, 0) << "no path has met such an image";
    EXPECT_LT(faint, largest / 20);
}

// Also with the Sobol sequence, whose samples have other neighbours in a register.
TEST(DeltaChains, AreTheSameWhateverTheyAreTracedWith) {
    for (const auto& [name, scene] : scenes()) {
        Emission emission(scene, SamplerType::sobol);
        const TileJob all{.x = 2, .y = 3, .width = 8, .height = 4, .first_sample = 5, .samples = 16};
        ASSERT_EQ(all.paths(), at_once);
        std::vector<double> expected;
        const HighlightPlaces places = any_places(*emission.context.settings.filter);
        const auto tile = std::make_unique<TileScratch>();
        tile->chains = std::make_unique<ChainColumns>();
        tile->chains->places = &places;
        const auto append = [&](std::vector<double>& to, const TileJob& job) {
            for (int k = 0; k < job.paths(); ++k)
                for (const double v : {tile->r[k], tile->g[k], tile->b[k], tile->chains->path_squares[k]}) to.push_back(v);
        };
        const Kernel& scalar = kernels_of("scalar").back();
        emission.run([&] { scalar.trace_chains(emission.context, all, *tile); });
        append(expected, all);
        ASSERT_GT(*std::ranges::max_element(expected), 0) << name;
        for (const std::string_view isa : runnable_isas())
            for (const Kernel& kernel : kernels_of(isa)) {
                if (!kernel.features.contains(emission.scene.features())) continue;
                std::vector<double> together, alone;
                emission.run([&] {
                    kernel.trace_chains(emission.context, all, *tile);
                    append(together, all);
                    for (int y = 0; y < all.height; ++y)
                        for (int x = 0; x < all.width; ++x) {
                            TileJob pixel = all;
                            pixel.x += x, pixel.y += y;
                            pixel.width = pixel.height = 1;
                            kernel.trace_chains(emission.context, pixel, *tile);
                            append(alone, pixel);
                        }
                });
                EXPECT_EQ(together, expected) << name << " " << isa << "/" << kernel.name;
                EXPECT_EQ(alone, expected) << name << " " << isa << "/" << kernel.name << " pixel by pixel";
            }
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
