// All strategies agree in the mean, block by block, on the shipped scenes; a biased one is detected.
#include "render/integrator/mis_weights.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <array>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

std::vector<Measured> blocks_of(const Scene& scene, RenderSettings settings, uint32_t seed) {
    settings.seed = seed;
    return render(scene, settings).blocks(settings.width / 2, settings.height / 2);
}

std::vector<Measured> with_strategy(const Scene& scene, Strategy strategy, int width, int height, int64_t spp) {
    RenderSettings settings = settings_for(width, height, spp);
    settings.strategy = strategy;
    return blocks_of(scene, settings, 1 + uint32_t(strategy));
}

TEST(Strategies, AgreeOnCornell) {
    const Scene scene = shipped_scene("cornell");
    const auto mis = with_strategy(scene, Strategy::mis, 32, 32, 64);
    EXPECT_TRUE(same_means(mis, with_strategy(scene, Strategy::light, 32, 32, 64), sidak(significance, 2))) << "light";
    EXPECT_TRUE(same_means(mis, with_strategy(scene, Strategy::bsdf, 32, 32, 512), sidak(significance, 2))) << "bsdf";
}

Scene rougher_veach_mis() {
    Scene scene = shipped_scene("veach-mis");
    for (const auto& [id, material] : Table<Material>(scene.materials)) {
        Material rougher = material;
        rougher.roughness = std::max(material.roughness, 0.2f);
        scene.materials.set(id, rougher);
    }
    return scene;
}

// If a strategy finds light only rarely, no affordable number of samples gives its variance. So the sharpest reflections are made
// rougher, and the upper left quarter, where the two smallest lights are below a pixel, is excluded.
TEST(Strategies, AgreeOnVeachMis) {
    const Scene scene = rougher_veach_mis();
    const auto three_quarters = [&](Strategy strategy, int64_t spp) {
        std::vector<Measured> blocks = with_strategy(scene, strategy, 32, 16, spp);
        blocks.erase(blocks.begin());
        return blocks;
    };
    const auto mis = three_quarters(Strategy::mis, 64);
    EXPECT_TRUE(same_means(mis, three_quarters(Strategy::light, 256), sidak(significance, 2))) << "light";
    EXPECT_TRUE(same_means(mis, three_quarters(Strategy::bsdf, 1024), sidak(significance, 2))) << "bsdf";
}

// The unmodified scene, with only the lights that suit each strategy: on the sharpest plate NEE rarely finds the reflection of
// the largest light, and BSDF sampling rarely hits the smallest one.
TEST(Strategies, AgreeOnVeachMisUnchanged) {
    const auto lit_by = [](std::initializer_list<std::string> lights) {
        Scene scene = shipped_scene("veach-mis");
        for (const auto& [id, material] : Table<Material>(scene.materials)) {
            Material m = material;
            if (m.name.starts_with("light") && !std::count(lights.begin(), lights.end(), m.name)) m.emissive_strength = 0;
            scene.materials.set(id, m);
        }
        return scene;
    };
    const auto expect_agreement = [](const Scene& scene, Strategy strategy, int64_t spp) {
        EXPECT_TRUE(same_means(with_strategy(scene, Strategy::mis, 32, 16, 256), with_strategy(scene, strategy, 32, 16, spp),
                               sidak(significance, 2)));
    };
    expect_agreement(lit_by({"light 1", "light 2"}), Strategy::light, 1024);
    expect_agreement(lit_by({"light 3", "light 4"}), Strategy::bsdf, 2048);
}

TEST(Strategies, AgreeOnCardAndMug) {
    const Scene scene = shipped_scene("card-and-mug");
    EXPECT_TRUE(same_means(with_strategy(scene, Strategy::mis, 32, 16, 256), with_strategy(scene, Strategy::light, 32, 16, 256)));
}

// The real sun covers a hundred-thousandth of the sky: one scattered ray in fifty thousand hits it, with the weight of all others
// together. This sun is twenty degrees wide, so that BSDF sampling alone gives a measurement.
TEST(Strategies, AgreeOnCardAndMugUnderAWideSun) {
    Scene scene = shipped_scene("card-and-mug");
    for (const auto& [id, light] : Table<Light>(scene.lights)) {
        Light wide = light;
        wide.angle_radians = 0.35f;
        scene.lights.set(id, wide);
    }
    const auto mis = with_strategy(scene, Strategy::mis, 32, 16, 64);
    EXPECT_TRUE(same_means(mis, with_strategy(scene, Strategy::light, 32, 16, 256), sidak(significance, 2))) << "light";
    EXPECT_TRUE(same_means(mis, with_strategy(scene, Strategy::bsdf, 32, 16, 512), sidak(significance, 2))) << "bsdf";
}

Scene lights_with_and_without_size() {
    Scene scene;
    place(scene, floor_quad(2), lambert(0.7f));
    place(scene, floor_quad(0.5f, 0.4f), plastic(0.5f));
    place(scene, ceiling_quad(1, 2), emitter(3));
    Light point;
    point.intensity = 4;
    place_light(scene, point, at({0.7f, 1, 0.2f}));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 2;
    place_light(scene, sun, aimed({0, 0, 0}, {0.6f, -1, 0.4f})); // parallel: a disk of no size
    sun.angle_radians = 0.8f;
    place_light(scene, sun, aimed({0, 0, 0}, {-0.6f, -1, 0.1f}));
    constant_world(scene, 0.3f);
    scene.view = looking_down(1.5f, 1);
    return scene;
}

// With BSDF sampling alone, lights of zero size are still sampled, because rays cannot hit them; no others are.
TEST(Strategies, AgreeUnderLightsWithAndWithoutSize) {
    const Scene scene = lights_with_and_without_size();
    const auto mis = with_strategy(scene, Strategy::mis, 16, 16, 256);
    EXPECT_TRUE(same_means(mis, with_strategy(scene, Strategy::bsdf, 16, 16, 1024)));
}

Scene glass_and_mirror() {
    Scene scene;
    place(scene, floor_quad(3), lambert(0.7f));
    place(scene, ceiling_quad(3, 3), lambert({0.3f, 0.6f, 0.9f}));
    place(scene, ceiling_quad(1.2f, 2.9f), emitter(3));
    place(scene, sphere(false), glass(0, 1.5f), at({-0.9f, 0.8f, 0.3f}, 0.7f));
    place(scene, sphere(false), metal(0), at({0.9f, 0.9f, -0.4f}, 0.8f));
    scene.view = looking({0, 1.5f, 6}, {0, 1.5f, 0}, 0.6f);
    return scene;
}

// BSDF sampling alone excludes caustic guiding (shading/caustic_guiding.h), so it is the reference that finds all light by chance.
TEST(Strategies, AgreeOnCaustics) {
    const Scene scene = glass_and_mirror();
    const auto by_chance = with_strategy(scene, Strategy::bsdf, 32, 32, 512);
    EXPECT_TRUE(same_means(by_chance, with_strategy(scene, Strategy::mis, 32, 32, 256), sidak(significance, 2)));
    RenderSettings shared = settings_for(32, 32, 256);
    shared.reuse = 8;
    EXPECT_TRUE(same_means(by_chance, blocks_of(scene, shared, 7), sidak(significance, 2))) << "path reuse";
}

constexpr std::array<const char*, 4> other_heuristics{"balance", "power=8", "cutoff=0.3", "maximum"};

void expect_heuristics_agree(const Scene& scene, int width, int height, int64_t spp, int reuse = 1) {
    RenderSettings settings = settings_for(width, height, spp);
    settings.reuse = reuse;
    const auto truth = blocks_of(scene, settings, 1);
    uint32_t seed = 2;
    for (const char* heuristic : other_heuristics) {
        settings.heuristic = *parse_heuristic(heuristic);
        EXPECT_TRUE(same_means(truth, blocks_of(scene, settings, seed++), sidak(significance, int64_t(other_heuristics.size()))))
            << heuristic;
    }
}

TEST(MisHeuristics, AgreeOnVeachMis) { expect_heuristics_agree(rougher_veach_mis(), 32, 16, 256); }

TEST(MisHeuristics, AgreeUnderLightsWithAndWithoutSize) { expect_heuristics_agree(lights_with_and_without_size(), 16, 16, 256); }

// Strategies for caustics are off with other heuristics, directions into glass are still sampled.
TEST(MisHeuristics, AgreeOnCaustics) { expect_heuristics_agree(glass_and_mirror(), 32, 32, 256); }

TEST(MisHeuristics, AgreeWithPathReuse) { expect_heuristics_agree(glass_and_mirror(), 32, 32, 256, 8); }

// The power heuristic with a large exponent is nearly the maximum heuristic; cutoff at 0 is the balance heuristic, at 1 the maximum.
TEST(MisHeuristics, AreLimitsOfEachOther) {
    const Scene scene = shipped_scene("veach-mis");
    const auto image = [&](const char* heuristic) {
        RenderSettings settings = settings_for(32, 16, 4);
        settings.heuristic = *parse_heuristic(heuristic);
        return render(scene, settings).frame.rgba;
    };
    EXPECT_EQ(image("cutoff=0"), image("balance"));
    EXPECT_EQ(image("cutoff=1"), image("maximum"));
    EXPECT_EQ(image("power=2"), image("power"));
    EXPECT_NE(image("balance"), image("power=2"));
    EXPECT_NE(image("maximum"), image("power=8"));
}

TEST(MisHeuristics, WeightsOfBothStrategiesSumToOne) {
    const float densities[] = {1e-30f, 0.3f, 1, 1 + 1e-7f, 7, 1e20f};
    for (const char* text : {"power=2", "balance", "power=3", "power=8", "cutoff=0", "cutoff=0.3", "cutoff=1", "maximum"}) {
        const MisHeuristic heuristic = *parse_heuristic(text);
        const MisSettings mis{Strategy::mis, heuristic == MisHeuristic{}, heuristic};
        for (const float light : densities)
            for (const float bsdf : densities)
                EXPECT_NEAR(nee_mis_weight<float>(mis, light, bsdf, false) + emission_mis_weight<float>(mis, bsdf, light), 1, 4e-7)
                    << text << ' ' << light << ' ' << bsdf;
    }
}

std::vector<Measured> with_roulette(const Scene& scene, const char* rule, uint32_t seed) {
    RenderSettings settings = settings_for(32, 32, 64);
    settings.roulette = *parse_roulette(rule);
    return blocks_of(scene, settings, seed);
}

TEST(Roulette, RulesAgreeOnCornellAndBiasIsDetected) {
    const Scene scene = shipped_scene("cornell");
    const auto truth = with_roulette(scene, "off", 1);
    const std::vector<const char*> rules = {"max", "max,start=1", "luminance", "sqrt", "constant=0.7,start=1", "max,floor=0.2,cap=0.9"};
    uint32_t seed = 2;
    for (const char* rule : rules)
        EXPECT_TRUE(same_means(truth, with_roulette(scene, rule, seed++), sidak(significance, int64_t(rules.size())))) << rule;
    EXPECT_FALSE(same_means(truth, with_roulette(scene, "biased-cut=0.2,start=1", seed), sidak(significance, int64_t(rules.size()))));
}

} // namespace
} // namespace blush::test::TEST_FILE
