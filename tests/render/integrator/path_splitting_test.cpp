// Splitting: copies of a path that are worth their work, without bias, for every kind of surface, and the same from every kernel.
#include "render/integrator/path_splitting.h"
#include "render/roulette/adjoint_pilot.h"
#include "tests/render/pilots/pilot_checks.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/images.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using Rule = Roulette::Rule;

RenderSettings settings_of(Rule rule, int width = 32, int height = 18, int64_t spp = 512) {
    RenderSettings settings = settings_for(width, height, spp);
    settings.roulette = {.rule = rule, .start = 1};
    return settings;
}

// Panes, blended surfaces, textures, and lamps of which paths may hit one: what copies must carry along for them.
Scene furnished_room() {
    Scene scene;
    place(scene, cube(true), lambert({0.7f, 0.6f, 0.5f}), at({0, 1, 0}, 1));
    Material leaf = lambert(0.6f);
    leaf.alpha = Material::Alpha::blend;
    leaf.opacity = 0.5f;
    place(scene, floor_quad(0.4f), leaf, at({0.1f, 0.7f, 0}));
    place(scene, floor_quad(0.5f), window_glass({0.9f, 0.95f, 1}), at({-0.2f, 1.2f, 0.1f}));
    Material checked = plastic(0.3f);
    checked.base_color_texture.texture = add_texture(
        scene,
        float_image(2, 2, std::array{Vec3{0.9f, 0.1f, 0.1f}, Vec3{0.1f, 0.9f, 0.1f}, Vec3{0.2f, 0.2f, 0.9f}, Vec3{0.8f, 0.8f, 0.8f}}));
    place(scene, floor_quad(0.9f), checked, at({0, 0.1f, 0}));
    for (const float x : {-0.8f, 0.2f, 0.8f}) {
        Light lamp;
        lamp.kind = Light::Kind::point;
        lamp.intensity = x > 0 ? 0.2f : 4.f;
        lamp.radius = x > 0.5f ? 0.05f : 0.f;
        place_light(scene, lamp, at({x, 1.7f, x}));
    }
    scene.view = looking({-0.9f, 1.0f, 0.9f}, {0.4f, 0.5f, -0.4f}, 1.2f);
    return scene;
}

TEST(PathSplitting, AgreesWithoutInAFurnishedRoom) {
    RenderSettings settings = settings_of(Rule::splitting);
    const auto with = render(furnished_room(), settings).blocks(8, 6);
    settings.roulette = {.rule = Rule::sqrt, .start = 8};
    settings.seed = 3;
    EXPECT_TRUE(same_means(with, render(furnished_room(), settings).blocks(8, 6)));
}

// Samples of a tile as every kernel renders them, with how many paths were shaded at each bounce.
struct Samples {
    std::vector<double> radiance;
    std::vector<int64_t> alive;
    bool operator==(const Samples&) const = default;
};
Samples samples_of(const KernelContext& context, const Kernel& kernel, const TileJob& job) {
    TileScratch tile;
    tile.roulette = std::make_unique<RouletteColumns>();
    kernel.render(context, job, tile);
    Samples samples;
    for (const Column<double>* c : {&tile.r, &tile.g, &tile.b})
        samples.radiance.insert(samples.radiance.end(), c->data, c->data + job.paths());
    for (const PathCounts& counts : tile.roulette->counts) samples.alive.push_back(counts.alive);
    return samples;
}

TEST(PathSplitting, GivesTheSameBitsFromEveryKernel) {
    for (const Scene& scene : {shipped_scene("corridor"), shipped_scene("prism"), furnished_room()}) {
        const RenderSettings settings = settings_of(Rule::splitting);
        RenderScene compiled;
        compiled.update(expand_area_lights(scene), settings, full_plan(), Workers(2));
        KernelContext context{&compiled.tables(), &compiled.accel(), kernel_settings(settings, settings.width, settings.height)};
        std::vector<std::unique_ptr<TileScratch>> scratch(2);
        const auto pilot = learn_adjoint(context, 1, kernels_of("scalar").back(), Workers(2), scratch, {});
        ASSERT_TRUE(pilot);
        SceneTables tables = compiled.tables();
        tables.adjoint = pilot->field.tables(settings.width, settings.height);
        ASSERT_TRUE(tables.adjoint.splits);
        context.scene = &tables;
        const TileJob job{8, 2, 16, 16, 4, 2, 1};
        Workers(1).run([&] {
            const Samples expected = samples_of(context, kernels_of("scalar").back(), job);
            EXPECT_GT(*std::ranges::max_element(expected.alive), job.paths());
            EXPECT_LE(*std::ranges::max_element(expected.alive), most_copies * job.paths());
            for (const std::string_view isa : runnable_isas())
                for (const Kernel& kernel : kernels_of(isa)) {
                    if (!kernel.features.contains(compiled.features())) continue;
                    EXPECT_EQ(samples_of(context, kernel, job), expected) << isa << " " << kernel.name;
                }
            // A sample does not depend on the others of its tile.
            const Samples alone = samples_of(context, kernels_of("scalar").back(), {11, 7, 1, 1, 5, 1, 1});
            const size_t slot = size_t((7 - 2) * 16 + 11 - 8) * 2 + 1;
            for (size_t c = 0; c < 3; ++c) EXPECT_EQ(alone.radiance[c], expected.radiance[c * size_t(job.paths()) + slot]);
        });
    }
}

TEST(PathSplitting, DoesNotDependOnPartsAndThreads) {
    const Scene scene = shipped_scene("corridor");
    RenderSettings settings = settings_of(Rule::splitting, 64, 36, 12);
    const Frame whole = rendered_in_parts(scene, settings, {{0, 12}});
    EXPECT_TRUE(same_pixels(whole, rendered_in_parts(scene, settings, {{0, 1}, {1, 4}, {5, 1}, {6, 6}}, 1)));
    RenderSettings efficiency = settings;
    efficiency.roulette.rule = Rule::efficiency;
    EXPECT_FALSE(same_pixels(whole, rendered_in_parts(scene, efficiency, {{0, 12}})));
    settings.adaptive = true;
    EXPECT_TRUE(same_pixels(rendered_in_parts(scene, settings, {{0, 24}}, 1), rendered_in_parts(scene, settings, {{0, 6}, {0, 18}})));
}

TEST(PathSplitting, ReducesTheVarianceOfASample) {
    const auto variance = [&](Rule rule) {
        std::vector<statistics::Moments> pixels;
        RenderSettings settings = settings_of(rule, 32, 18, 16);
        double sum = 0;
        for (settings.seed = 1; settings.seed <= 16; ++settings.seed) {
            const Frame frame = rendered_in_parts(shipped_scene("corridor"), settings, {{4, 16}});
            pixels.resize(size_t(frame.width * frame.height));
            for (size_t k = 0; k < pixels.size(); ++k) pixels[k].add(double(frame.rgba[4 * k + 1]));
        }
        for (const auto& pixel : pixels) sum += pixel.variance();
        return sum;
    };
    EXPECT_LT(variance(Rule::splitting), 0.8 * variance(Rule::efficiency));
}

// Path reuse, light paths and manifold sampling pair vertices of a sample.
TEST(PathSplitting, LeavesSamplesThatShareVerticesWhole) {
    RenderSettings settings = settings_of(Rule::splitting, 64, 36, 8), efficiency = settings;
    efficiency.roulette.rule = Rule::efficiency;
    const Scene pool = shipped_scene("pool");
    EXPECT_TRUE(same_pixels(rendered_in_parts(pool, settings, {{0, 8}}), rendered_in_parts(pool, efficiency, {{0, 8}})));
    settings.reuse = efficiency.reuse = 8;
    const Scene box = shipped_scene("cornell");
    EXPECT_TRUE(same_pixels(rendered_in_parts(box, settings, {{0, 8}}), rendered_in_parts(box, efficiency, {{0, 8}})));
}

} // namespace
} // namespace blush::test::TEST_FILE
