// The pilot of small highlights: its estimate against the geometry of a mirror, and that it makes errors unknown where both halves of the
// samples miss a highlight.
#include "render/pilots/edges/highlight_pilot.h"

#include "tests/render/pilots/pilot_checks.h"
#include "tests/render/scenes.h"

#include <cmath>
#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

constexpr double lamp_x = 0.6, lamp_side = 0.02, lamp_nits = 1000, cone_degrees = 15;
constexpr float yfov = 1;

// A lamp of 2 cm, 1 m before a mirror, seen from 2 m away in that mirror alone.
Scene lamp_before_a_mirror() {
    Scene scene;
    place(scene, quad({-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}), metal(0));
    const float low = float(lamp_x - lamp_side / 2), high = float(lamp_x + lamp_side / 2), h = float(lamp_side / 2);
    place(scene, quad({low, -h, 1}, {low, h, 1}, {high, h, 1}, {high, -h, 1}), emitter(float(lamp_nits)));
    scene.view = looking({0, 0, 2}, {0, 0, 0}, yfov);
    return scene;
}

SmallHighlights found_in(const Scene& scene, const RenderSettings& settings, unsigned threads = 2) {
    RenderScene compiled;
    compiled.update(expand_area_lights(scene), settings, full_plan(), Workers(2));
    const KernelContext context{&compiled.tables(), &compiled.accel(), kernel_settings(settings, settings.width, settings.height)};
    const Workers workers(threads);
    std::vector<std::unique_ptr<TileScratch>> scratch(workers.threads());
    return highlights_of(find_small_highlights(context, choose_kernel(compiled.features()), workers, scratch, {}).value());
}

double total_rate(const SmallHighlights& found) {
    double rate = 0;
    for (const auto& band : found.bands) rate += band.rate;
    return rate;
}

// Mean and variance of the estimate of one path over all directions of the camera, by quadrature.
struct Moments {
    double mean = 0, variance = 0;
};
Moments kernel_estimate() {
    constexpr int n = 2000;
    const double half = std::tan(double(yfov) / 2), cos_cone = std::cos(cone_degrees * std::numbers::pi / 180);
    const double cone = 2 * std::numbers::pi * (1 - cos_cone);
    double sum = 0, squares = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const Vec3d d = normalize(Vec3d{half * (2 * (i + 0.5) / n - 1), half * (2 * (j + 0.5) / n - 1), 1});
            const Vec3d at{2 * d.x / d.z, 2 * d.y / d.z, 0}, to = Vec3d{lamp_x, 0, 1} - at;
            const double r = length(to), cosine = to.z / r;
            if (dot(to, d) / r < cos_cone) continue; // reflected, the ray has the direction d again: z is turned round twice
            const double w = lamp_side * lamp_side * cosine / (r * r) / cone;
            sum += w;
            squares += w * w;
        }
    const double mean = sum / (double(n) * n);
    return {mean, squares / (double(n) * n) - mean * mean};
}

TEST(HighlightPilot, EstimatesHowMuchOfTheImageALampInAMirrorCovers) {
    const SmallHighlights found = found_in(lamp_before_a_mirror(), settings_for(64, 64, 16));
    const Moments expected = kernel_estimate();
    // All squares of pixels meet the mirror, so 16 paths for each of 64 x 64 pixels look for the lamp.
    const double sigma = std::sqrt(expected.variance / (16 * 64 * 64));
    EXPECT_NEAR(total_rate(found), expected.mean, 4 * sigma);
    EXPECT_LT(4 * sigma, 0.2 * expected.mean) << "too noisy to show a wrong estimate";
    // The lamp behind the mirror, projected onto the image plane.
    const double seen = std::pow(lamp_side / 3 / (2 * std::tan(double(yfov) / 2)), 2);
    EXPECT_NEAR(expected.mean, seen, 0.2 * seen) << "the kernel spreads the lamp too far";
    Vec3d sum{0, 0, 0};
    for (const auto& band : found.bands) sum = sum + band.sum;
    EXPECT_NEAR(sum.x, lamp_nits * total_rate(found), 1e-3 * lamp_nits * total_rate(found)) << "a white mirror keeps the radiance";
}

TEST(HighlightPilot, FindsTheSameOnAnyNumberOfThreads) {
    const RenderSettings settings = settings_for(64, 36, 16);
    for (const Scene& scene : {lamp_before_a_mirror(), shipped_scene("bulb")})
        EXPECT_EQ(found_in(scene, settings, 1), found_in(scene, settings, 3));
}

TEST(HighlightPilot, FindsNothingThatIsOccludedOrNotSmooth) {
    Scene hidden = lamp_before_a_mirror();
    place(hidden, quad({0.3f, -0.4f, 0.9f}, {0.9f, -0.4f, 0.9f}, {0.9f, 0.4f, 0.9f}, {0.3f, 0.4f, 0.9f}), lambert(0.5f));
    EXPECT_EQ(found_in(hidden, settings_for(64, 64, 16)), SmallHighlights{});
    EXPECT_EQ(found_in(shipped_scene("card-and-mug"), settings_for(64, 36, 16)), SmallHighlights{});
}

ErrorEstimate error_of(const Scene& scene, int64_t spp, FilmState* state = nullptr) {
    Renderer renderer;
    renderer.update(scene, settings_for(64, 36, spp));
    EXPECT_TRUE(renderer.render(0, spp));
    if (state) *state = *renderer.save_film(0);
    return renderer.resolve().error;
}

// At this size the lamp in the gold of the metal ring covers a hundredth of a pixel, which is 0.07 of the RMSE; samples without it
// estimated 0.03 with an interval of 10 %.
TEST(HighlightPilot, RaisesTheErrorWhereHighlightsMayBeMissing) {
    for (const auto& [name, spp] : {std::pair("metal-ring", 2), std::pair("wine-glass", 16), std::pair("bulb", 2)}) {
        FilmState state;
        const ErrorEstimate error = error_of(shipped_scene(name), spp, &state);
        EXPECT_TRUE(error.misses_highlights) << name;
        EXPECT_FALSE(error.rmse_known && error.rmse_high > 10 * error.rmse_low) << name;
        const ErrorEstimate saved = resolve_film(state, settings_for(64, 36, spp))->frame.error;
        EXPECT_TRUE(saved.misses_highlights) << name;
        EXPECT_EQ(saved.rmse_high, error.rmse_high) << name;
        state.highlights.reset();
        const ErrorEstimate without = resolve_film(state, settings_for(64, 36, spp))->frame.error;
        EXPECT_FALSE(without.misses_highlights) << name;
        EXPECT_GT(error.rmse_high, 1.04 * without.rmse_high) << name;
        EXPECT_EQ(error.rmse, without.rmse) << name;
        EXPECT_EQ(error.rmse_low, without.rmse_low) << name;
    }
}

TEST(SmallHighlights, RaiseTheUpperEndsOfIntervals) {
    SmallHighlights lamp;
    lamp.of(400) = {1e-5, {4e-3, 4e-3, 4e-3}}; // 8 nits in one of 2000 pixels
    constexpr double values = 3 * 2000;
    const ErrorEstimate before{true, 0.01, 0.009, 0.011, true, 0.1, 0.09, 0.11, false};
    ErrorEstimate error = before;
    include_small_highlights(error, lamp, 16, 50, 40);
    EXPECT_TRUE(error.misses_highlights && error.rmse_known && error.known);
    EXPECT_NEAR(error.rmse_high, std::sqrt(0.11 * 0.11 + 3 * 64 / values), 1e-9);
    EXPECT_EQ(error.rmse_low, before.rmse_low);
    EXPECT_EQ(error.high, before.high) << "at most 3 of 60 relative squares are missing";
    error.relmse = 0.004, error.low = 0.0035, error.high = 0.0045;
    include_small_highlights(error, lamp, 16, 50, 40);
    EXPECT_NEAR(error.high, 0.0045 + 3 * 64 / 64.01 / values, 1e-9);
    error = before;
    error.rmse = 0.01, error.rmse_low = 0.009, error.rmse_high = 0.011;
    include_small_highlights(error, lamp, 16, 50, 40);
    EXPECT_FALSE(error.rmse_known) << "a factor of 20";
    EXPECT_TRUE(error.known);
    error = before;
    include_small_highlights(error, lamp, 1001, 50, 40);
    EXPECT_FALSE(error.misses_highlights) << "20 samples meet it";
    EXPECT_EQ(error.rmse_high, before.rmse_high);
}

TEST(HighlightPilot, LeavesTheErrorKnownElsewhere) {
    for (const char* name : {"card-and-mug", "pool"}) {
        const ErrorEstimate error = error_of(shipped_scene(name), 4);
        EXPECT_FALSE(error.misses_highlights) << name;
        EXPECT_TRUE(error.known && error.rmse_known) << name;
    }
}

TEST(SmallHighlights, AreHardlyMetByFewSamplesOnly) {
    SmallHighlights lamp;
    lamp.of(400) = {1e-5, {4e-3, 4e-3, 4e-3}}; // 1e-5 of 2000 pixels: 0.02 of a pixel, which is 8 nits brighter for it
    const double squares = 3 * 64;             // of 8 nits in one pixel
    for (const int samples : {1, 16, 999}) {
        EXPECT_NEAR(lamp.missed(samples, 2000).squares, squares, 1e-9 * squares);
        EXPECT_NEAR(lamp.missed(samples, 2000).relative, 3 * 64 / 64.01, 1e-9);
    }
    EXPECT_EQ(lamp.missed(1001, 2000).squares, 0) << "20 samples meet it";
    EXPECT_EQ(lamp.missed(1001, 2000).relative, 0);
    EXPECT_EQ(SmallHighlights{}.missed(1, 2000).squares, 0);
    lamp.of(400) = {2e-3, {4e-3, 4e-3, 4e-3}}; // 2 nits in each of four pixels
    EXPECT_NEAR(lamp.missed(4, 2000).squares, 3 * 4 * 4, 1e-9);
    EXPECT_NEAR(lamp.missed(4, 2000).relative, 3 * 4 * 4 / 4.01, 1e-9);
    EXPECT_EQ(&lamp.of(400), &lamp.of(300)); // the octave from 256 to 512
    EXPECT_NE(&lamp.of(400), &lamp.of(200));
    EXPECT_EQ(&lamp.of(0), &lamp.bands.front());
    EXPECT_EQ(&lamp.of(1e300, faint_highlight_samples), &lamp.bands.back());
}

TEST(SmallHighlights, AreMetMoreOftenInPixelsThatTakeMoreSamplesOfThem) {
    for (const int each : {highlight_samples, bright_highlight_samples}) {
        SmallHighlights lamp;
        lamp.add(400, {1e-5, {4e-3, 4e-3, 4e-3}}, each);
        EXPECT_GT(lamp.missed(999.0 / each, 2000).squares, 0) << each;
        EXPECT_EQ(lamp.missed(1001.0 / each, 2000).squares, 0) << each;
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
