// Closed rooms with uniform emission and albedo: light is reflected infinitely often, and its sum is known.
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

constexpr float emission = 2;

Scene room(const GeometryPtr& walls, float albedo) {
    Scene scene;
    place(scene, walls, emitter(emission, albedo));
    scene.view = looking({0.1f, -0.2f, 0.3f}, {0.9f, 0.35f, -0.8f}, 1.2f);
    return scene;
}

struct Rule {
    const char* text;
    int64_t spp;
};

// Le (1 + albedo + albedo^2 + ...) = Le / (1 - albedo) everywhere.
void expect_series(float albedo, std::initializer_list<Rule> rules, int pixels = 16) {
    for (const GeometryPtr& walls : {cube(true), sphere(true)})
        for (const Rule& rule : rules) {
            RenderSettings settings = settings_for(pixels, pixels, rule.spp);
            settings.roulette = *parse_roulette(rule.text);
            EXPECT_TRUE(is_mean(render(room(walls, albedo), settings).whole(), emission / (1 - double(albedo)),
                                sidak(significance, 2 * int64_t(rules.size()))))
                << rule.text << ", albedo " << albedo << ", " << walls->triangle_count() << " triangles";
        }
}

TEST(Enclosure, OfAlbedoOneHalf) {
    expect_series(0.5f, {{"off", 16}, {"max", 64}, {"luminance", 64}, {"sqrt", 64}, {"constant=0.8", 64}, {"max,start=1", 64}});
}
TEST(Enclosure, OfAlbedoNineTenths) {
    expect_series(0.9f, {{"off", 4}, {"max", 32}, {"luminance", 32}, {"sqrt", 32}, {"constant=0.95", 32}});
}
// A constant rule needs a survival probability above the square of the albedo, or its variance is infinite.
TEST(Enclosure, OfAlbedoNinetyNineHundredths) {
    expect_series(0.99f, {{"max", 16}, {"luminance", 16}, {"sqrt", 16}, {"constant=0.995", 16}});
}
// Without roulette each path continues until its throughput underflows, after ten thousand bounces.
TEST(Enclosure, OfAlbedoNinetyNineHundredthsWithoutRoulette) { expect_series(0.99f, {{"off", 2}}, 8); }

// Cutting paths without compensating the throughput loses light, and this test detects it.
TEST(Enclosure, BiasedCutIsCaught) {
    RenderSettings settings = settings_for(16, 16, 64);
    settings.roulette = *parse_roulette("biased-cut=0.1");
    const Measured seen = render(room(cube(true), 0.5f), settings).whole();
    EXPECT_FALSE(is_mean(seen, emission / 0.5));
    EXPECT_LT(seen.mean.x, emission / 0.5);
}

TEST(Enclosure, BouncesAddUpTermByTerm) {
    double sum = 0, term = emission;
    for (int bounces = 0; bounces <= 4; ++bounces, term *= 0.8f) {
        sum += term;
        RenderSettings settings = settings_for(16, 16, 32);
        settings.max_bounces = bounces;
        EXPECT_TRUE(is_mean(render(room(cube(true), 0.8f), settings).whole(), sum, sidak(significance, 5))) << bounces << " bounces";
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
