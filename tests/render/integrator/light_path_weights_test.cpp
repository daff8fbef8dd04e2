// Wrong MIS weights of light paths do not agree with the other strategies: the z-test that light_paths_test.cpp relies on catches them. The
// wrong weights are made here, from the parts of an image: what paths of the camera find, and splats.
#include "render/integrator/light_path_weights.h"

#include "render/film/film_planes.h"
#include "render/integrator/light_path_emission.h"
#include "scene/affine.h"
#include "tests/render/integrator/caustic_images.h"
#include "tests/support/statistics.h"

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

constexpr int side = 36;
constexpr float share = 0.5f;
constexpr auto paths = int64_t(share * side * side);

// Rough metal and rough glass in the light of a large lamp: each strategy finds much of it.
Scene rough_balls() {
    Scene scene;
    place(scene, floor_quad(2), lambert({0.7f, 0.6f, 0.5f}));
    place(scene, sphere(false), metal(0.2f), at({-0.7f, 0.5f, 0}, 0.5f));
    place(scene, sphere(false), glass(0.2f, 1.5f), at({0.7f, 0.5f, 0.2f}, 0.5f));
    place(scene, ceiling_quad(2, 2.5f), emitter(1));
    scene.view = looking({0, 2.5f, 4}, {0, 0.3f, 0}, 0.6f);
    return scene;
}
RenderSettings seeded(int64_t spp, uint32_t seed) {
    RenderSettings settings = settings_for(side, side, spp);
    settings.caustics = CausticStrategy::light_paths;
    settings.seed = seed;
    return settings;
}

using Pixels = std::vector<Vec3d>;
struct Parts {
    Pixels camera, splats; // sum up to the image
};
Parts parts_of(const Scene& scene, const RenderSettings& settings, float light_paths) {
    Renderer renderer({.threads = 2, .caustics = {.light_path_share = light_paths, .manifold_sampling = false}});
    renderer.update(scene, settings);
    EXPECT_TRUE(renderer.render(0, settings.spp));
    const Result<FilmState> film = renderer.save_film(0);
    Parts parts{Pixels(side * side), Pixels(side * side)};
    const auto add = [&](Pixels& to, const std::string& name) {
        const LosslessPlane* planes[3] = {film->find(name + ".R"), film->find(name + ".G"), film->find(name + ".B")};
        if (!planes[0]) return;
        const double scale = 1 / double(settings.spp); // both halves have as many samples and passes
        for (size_t i = 0; i < to.size(); ++i) to[i] = to[i] + Vec3d{planes[0]->sum(i), planes[1]->sum(i), planes[2]->sum(i)} * scale;
    };
    for (int half = 0; half < 2; ++half) {
        add(parts.camera, half == 0 ? "even" : "odd");
        add(parts.splats, FilmPlanes::splat_name(half));
    }
    return parts;
}

// The splats of the same light paths with the weights for `counted` light paths.
Pixels splats_weighted_for(float counted, const Scene& scene, const RenderSettings& settings) {
    RenderScene compiled;
    compiled.update(expand_area_lights(scene), settings, full_plan(), Workers(1));
    SceneTables tables = compiled.tables();
    const LightPathEmission emission(tables, compiled.bounding_sphere());
    tables.emission = emission.tables(counted);
    const KernelContext context{&tables, &compiled.accel(), kernel_settings(settings, side, side), settings.seed};
    const Kernel kernel = kernels_of("scalar").back();
    const auto scratch = std::make_unique<TileScratch>();
    Pixels pixels(side * side);
    // Flux is a share of one of `counted` paths, so it is scaled back to one of `paths`.
    const double scale = double(counted) / double(paths) / double(settings.spp);
    Workers(1).run([&] {
        for (int64_t pass = 0; pass < settings.spp; ++pass) {
            trace_light_path_tile(context, kernel, emission, {pass, paths, 0, int(paths)}, *scratch);
            for (const Splat& s : scratch->light_paths->splats)
                pixels[size_t(s.pixel)] = pixels[size_t(s.pixel)] + to_double(s.radiance) * scale;
        }
    });
    return pixels;
}

// Blocks of the sums of two parts of independent images.
std::vector<Measured> blocks_of(int images, uint32_t first_seed, const auto& parts) {
    constexpr int n = 3, size = side / n;
    BlockMoments moments;
    for (int k = 0; k < images; ++k) {
        const auto [a, b] = parts(first_seed + uint32_t(k));
        std::array<Measured, n * n> blocks{};
        for (size_t i = 0; i < a.size(); ++i) {
            Vec3d& mean = blocks[i / side / size * n + i % side / size].mean;
            mean = mean + (a[i] + b[i]) * (1.0 / (size * size));
        }
        moments.add(blocks);
    }
    return moments.measured();
}

TEST(LightPathWeights, ThatAreWrongDoNotAgree) {
    const Scene scene = rough_balls();
    constexpr int images = 16;
    const auto alone = [&](uint32_t seed) { return parts_of(scene, seeded(16, seed), 0).camera; };
    const auto without = blocks_of(images, 1, [&](uint32_t seed) { return std::pair{alone(seed), Pixels(side * side)}; });
    std::vector<Pixels> cameras;
    for (uint32_t k = 0; k < images; ++k) cameras.push_back(parts_of(scene, seeded(8, 1000 + k), share).camera);
    const auto weighted_for = [&](float counted) {
        return blocks_of(images, 1000, [&](uint32_t seed) {
            return std::pair{cameras[seed - 1000], splats_weighted_for(counted, scene, seeded(8, seed))};
        });
    };
    // What is taken apart here is the image.
    const Parts parts = parts_of(scene, seeded(2, 7), share);
    const Pixels again = splats_weighted_for(float(paths), scene, seeded(2, 7));
    for (size_t i = 0; i < again.size(); ++i) ASSERT_NEAR(parts.splats[i].y, again[i].y, float_rounding * again[i].y) << i;

    EXPECT_TRUE(same_means(weighted_for(float(paths)), without));
    EXPECT_FALSE(same_means(weighted_for(1), without)) << "without the number of light paths";
    EXPECT_FALSE(same_means(weighted_for(2 * float(paths)), without)) << "twice the number of light paths";
    EXPECT_FALSE(same_means(weighted_for(1e6f * float(paths)), without)) << "weight 1 of light paths";
    const auto twice = blocks_of(images, 2000, [&](uint32_t seed) {
        return std::pair{alone(seed), parts_of(scene, seeded(16, seed), share).splats};
    });
    EXPECT_FALSE(same_means(twice, without)) << "weights of the camera's paths as if there were no light paths";
}

} // namespace
} // namespace blush::test::TEST_FILE
