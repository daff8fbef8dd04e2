// Adaptive sampling: unbiased for any correlation of noise and value, its estimated error is the true error, and the image
// depends only on scene, settings and number of samples.
#include "core/math.h"
#include "render/film/film.h"
#include "render/film/pilot_variance.h"
#include "render/film/sample_allocation.h"
#include "tests/render/reference_scenes.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"
#include "tests/support/images.h"

#include <algorithm>
#include <memory>
#include <numbers>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

// ---- without a renderer: samples drawn from a known distribution

// Two by two tiles.
constexpr int tile_size = SampleAllocation::tile_size, size = 2 * tile_size;
using Draw = float (*)(std::mt19937_64& bits, int tile);

// Mostly around 1, rarely a firefly: a tile without fireflies in its pilot looks quiet.
constexpr double firefly = 1000, firefly_chance = 1e-4, firefly_mean = 1 + firefly * firefly_chance;
float with_fireflies(std::mt19937_64& bits, int) {
    const uint64_t b = bits();
    const float calm = 0.95f + 0.1f * float(b >> 40) * 0x1p-24f;
    return calm + (double(uint32_t(b)) * 0x1p-32 < firefly_chance ? float(firefly) : 0.f);
}
// Exponential, with a mean of 1: noisy only in the last tile.
float noisy_in_a_corner(std::mt19937_64& bits, int tile) {
    const float exponential = -std::log(float((bits() >> 40) + 1) * 0x1p-24f);
    return tile == 3 ? exponential : 0.9f + 0.1f * exponential;
}

enum class Rule { uniform, crossed, uncrossed }; // uncrossed: each half decides for itself, which is biased

// A film of such samples, `spp` per pixel on average.
struct Sampled {
    Film film;
    std::unique_ptr<TileScratch> scratch = std::make_unique<TileScratch>();
    std::mt19937_64 bits;

    Sampled(uint64_t seed, Draw draw, Rule rule, int64_t spp) : bits(seed) {
        film.reset({size, size, {}, false, rule != Rule::uniform});
        SampleAllocation plan;
        PilotVariance noise;
        plan.reset(size, size);
        for (int64_t from = 0; from < spp;) {
            const int64_t to = std::min(spp, SampleAllocation::next_measurement(from));
            for (int tile = 0; tile < plan.tiles(); ++tile)
                for (int half = 0; half < 2; ++half) add(draw, tile, half, plan.samples(tile, half, from), plan.samples(tile, half, to));
            from = to;
            if (rule == Rule::uniform) continue;
            if (from == SampleAllocation::pilot_samples / 2) noise.mark(film);
            if (from != SampleAllocation::pilot_samples) continue;
            std::array<TileNoise, 2> measured = noise.measure(film);
            if (rule == Rule::uncrossed) std::swap(measured[0], measured[1]);
            plan.decide(measured);
        }
    }
    void add(Draw draw, int tile, int half, int64_t from, int64_t to) {
        for (int64_t first = from; first < to; first += 8) {
            const int count = int(std::min<int64_t>(8, to - first));
            const TileJob job{tile % 2 * tile_size, tile / 2 * tile_size, tile_size, tile_size, 2 * first + half, count, 2};
            for (int slot = 0; slot < job.paths(); ++slot) scratch->r[slot] = scratch->g[slot] = scratch->b[slot] = draw(bits, tile);
            film.add(job, *scratch, 0);
        }
    }
    Frame frame() const {
        Frame f;
        film.resolve(f, Workers(1));
        f.error = film.estimate_error(Workers(1));
        return f;
    }
};

// Means of whole images.
Moments means(Rule rule) {
    Moments m;
    for (uint64_t seed = 0; seed < 300; ++seed) {
        const Frame frame = Sampled(seed, with_fireflies, rule, 64).frame();
        double sum = 0;
        for (size_t i = 0; i < frame.rgba.size(); i += 4) sum += double(frame.rgba[i]);
        m.add(sum / (size * size));
    }
    return m;
}

TEST(Adaptive, IsUnbiasedWithFirefliesOnlyIfHalvesDecideForEachOther) {
    const double alpha = sidak(significance, 2);
    EXPECT_TRUE(z_test(means(Rule::uniform), firefly_mean, alpha));
    EXPECT_TRUE(z_test(means(Rule::crossed), firefly_mean, alpha));
    EXPECT_FALSE(z_test(means(Rule::uncrossed), firefly_mean, alpha)) << "the test must detect this bias";
}

TEST(Adaptive, EstimatedErrorIsTheTrueError) {
    Moments stated_beyond_true; // squared, summed over an image
    int64_t inside = 0;
    constexpr int64_t runs = 300;
    for (int64_t seed = 0; seed < runs; ++seed) {
        const Sampled sampled(uint64_t(seed), noisy_in_a_corner, Rule::crossed, 48);
        const Frame frame = sampled.frame();
        const std::vector<Vec3> stated = sampled.film.standard_error();
        double sum = 0, relmse = 0;
        for (size_t i = 0; i < stated.size(); ++i) {
            const double squared_error = std::pow(double(frame.rgba[4 * i]) - 1, 2);
            sum += std::pow(double(stated[i].x), 2) - squared_error;
            relmse += squared_error / 1.01 / (size * size);
        }
        stated_beyond_true.add(sum);
        inside += frame.error.low <= relmse && relmse <= frame.error.high;
    }
    EXPECT_TRUE(z_test(stated_beyond_true, 0));
    // The interval is for the expectation, and this run is one draw:
    // with equal scatter of both, it holds at 1.96 / sqrt(2) sigma.
    const double chance = 1 - normal_p(1.96 / std::numbers::sqrt2);
    EXPECT_GT(double(inside) / double(runs), chance - 4 * std::sqrt(chance * (1 - chance) / double(runs)));
}

TEST(Adaptive, CountsItsSamplesPixelByPixel) {
    const Frame frame = Sampled(7, noisy_in_a_corner, Rule::crossed, 64).frame();
    ASSERT_EQ(frame.pixel_samples.size(), size_t(size * size));
    double sum = 0;
    for (const float n : frame.pixel_samples) {
        EXPECT_GE(n, float(SampleAllocation::pilot_samples));
        sum += double(n) / (size * size);
    }
    EXPECT_NEAR(sum, 64, double(SampleAllocation::granularity));
    EXPECT_GT(frame.pixel_samples.back(), 1.5f * frame.pixel_samples.front());
}

// Two distant tiles, one of brightness 0.03, one of brightness 1, both with a relative noise of a tenth: the measured noise must
// be that of relmse, or dark regions get too few samples.
TEST(Adaptive, MeasuresTheNoiseThatRelmseMeasures) {
    constexpr int tiles = 9; // smoothing reaches one tile
    constexpr float dark = 0.03f, bright = 1;
    Film film;
    film.reset({tiles * tile_size, tile_size, {}, false, true});
    PilotVariance noise;
    const auto scratch = std::make_unique<TileScratch>();
    std::mt19937_64 bits(1);
    const auto add = [&](int first, int count) {
        for (int tile = 0; tile < tiles; ++tile)
            for (int half = 0; half < 2; ++half) {
                const TileJob job{tile * tile_size, 0, tile_size, tile_size, 2 * first + half, count, 2};
                for (int slot = 0; slot < job.paths(); ++slot) {
                    const float value = (tile < tiles / 2 ? dark : bright) * (0.9f + 0.2f * float(bits() >> 40) * 0x1p-24f);
                    scratch->r[slot] = scratch->g[slot] = scratch->b[slot] = value;
                }
                film.add(job, *scratch, 0);
            }
    };
    add(0, SampleAllocation::pilot_samples / 4);
    noise.mark(film);
    add(SampleAllocation::pilot_samples / 4, SampleAllocation::pilot_samples / 4);
    const std::array<TileNoise, 2> measured = noise.measure(film);
    const double expected = (dark / std::hypot(dark, 0.1f)) / (bright / std::hypot(bright, 0.1f));
    // The variance of 256 pixels has a relative standard error of sqrt(2 / 256), its root half of that, and there are two of them.
    const double error = expected * std::sqrt(2.0 / (tile_size * tile_size)) / 2 * std::numbers::sqrt2;
    for (const TileNoise& half : measured) EXPECT_NEAR(half.front() / half.back(), expected, 4 * error);
}

// ---- with a renderer

RenderSettings adaptive_settings(int width, int height, int64_t spp) {
    RenderSettings settings = settings_for(width, height, spp);
    settings.adaptive = true;
    return settings;
}

TEST(Adaptive, ThreadsAndStepsDoNotChangeABit) {
    const Scene scene = shipped_scene("veach-mis");
    const RenderSettings settings = adaptive_settings(83, 50, 64);
    const Frame once = render_in_steps(scene, settings, all_planes(1), {64});
    for (const Frame& other : {render_in_steps(scene, settings, all_planes(2), {64}),
                               render_in_steps(scene, settings, all_planes(2), {1, 2, 4, 7, 16, 17, 30, 64}),
                               render_in_steps(scene, settings, all_planes(1), {13, 51, 64})}) {
        EXPECT_EQ(once.rgba, other.rgba);
        EXPECT_EQ(once.albedo, other.albedo);
        EXPECT_EQ(once.depth, other.depth);
        EXPECT_EQ(once.pixel_samples, other.pixel_samples);
        EXPECT_EQ(once.rays.total(), other.rays.total());
        EXPECT_EQ(once.error.relmse, other.error.relmse);
    }
}

TEST(Adaptive, SpendsTheGivenNumberOfSamples) {
    const Scene scene = shipped_scene("cornell");
    const Frame frame = render_in_steps(scene, adaptive_settings(250, 140, 40), all_planes(0), {40});
    EXPECT_EQ(frame.samples, 40);
    double sum = 0;
    for (const float n : frame.pixel_samples) sum += double(n);
    EXPECT_EQ(sum, double(frame.rays.camera));
    const double mean = sum / (250 * 140);
    // Tiles get whole multiples of a few samples, and their rounding is staggered.
    EXPECT_NEAR(mean, 40, 1);
    EXPECT_GT(*std::max_element(frame.pixel_samples.begin(), frame.pixel_samples.end()), 60);
}

TEST(Adaptive, AddsNoPlaneWhenItIsOff) {
    EXPECT_TRUE(render_in_steps(shipped_scene("cornell"), settings_for(32, 32, 32), all_planes(1), {32}).pixel_samples.empty());
}

// Compares with uniform sampling of the same scene, block by block, with the variances that both measure.
TEST(Adaptive, HasTheMeanOfUniformSampling) {
    for (const char* name : {"cornell", "card-and-mug"}) {
        const Scene scene = shipped_scene(name);
        RenderSettings settings = settings_for(64, 64, 64);
        const auto evenly = render(scene, settings).blocks(16, 16);
        settings.adaptive = true;
        settings.seed = 1;
        EXPECT_TRUE(same_means(evenly, render(scene, settings).blocks(16, 16), sidak(significance, 2))) << name;
    }
}

// The pilot does not see rare highlights, and takes a tile that has them for a quiet one. The minimum share bounds what that costs:
// no tile gets less than 3/4 of the samples, so no variance exceeds 4/3 of that of uniform sampling.
TEST(Adaptive, MissedHighlightsCostNoMoreThanTheMinimumShareAllows) {
    const Scene scene = shipped_scene("veach-mis");
    const RenderedImage truth = read_reference(coverage_reference_file("veach-mis")).mean;
    RenderSettings settings = coverage_settings();
    settings.spp = 256;
    const auto relmse_of = [&](bool adaptive) {
        settings.adaptive = adaptive;
        const Frame frame = stability::render(scene, settings).frame;
        for (const float n : frame.pixel_samples) EXPECT_GE(n, 0.75f * float(settings.spp) - float(SampleAllocation::granularity));
        double sum = 0;
        for (size_t i = 0; i < truth.pixels.size(); ++i)
            for (size_t c = 0; c < 3; ++c) {
                const double exact = (&truth.pixels[i].x)[c];
                sum += std::pow(double(frame.rgba[4 * i + c]) - exact, 2) / (exact * exact + 0.01);
            }
        return sum;
    };
    Moments log_ratio; // its scatter is that of the few highlights
    for (uint32_t seed = 1; seed <= 16; ++seed) {
        settings.seed = seed;
        log_ratio.add(std::log(relmse_of(true) / relmse_of(false)));
    }
    EXPECT_LT(log_ratio.error(), 0.1);
    EXPECT_LT(log_ratio.mean, std::log(4.0 / 3)) << "+- " << log_ratio.error();
}

// With equal weights of the halves, their coverage has equal weights too: a floor that covers a quarter of the image, under a sky
// that is hidden from the camera.
TEST(Adaptive, KeepsCoverage) {
    Scene scene;
    place(scene, floor_quad(0.5f), lambert(0.5f));
    constant_world(scene, 1);
    scene.environment.visible_to_camera = false;
    scene.view = looking_down(1, 1);
    RenderSettings settings = settings_for(50, 50, 48);
    const Frame evenly = render_in_steps(scene, settings, all_planes(1), {48});
    settings.adaptive = true;
    const Frame adapted = render_in_steps(scene, settings, all_planes(1), {48});
    int full = 0, empty = 0;
    for (size_t i = 3; i < evenly.rgba.size(); i += 4) {
        if (evenly.rgba[i] != 1 && evenly.rgba[i] != 0) continue;
        (evenly.rgba[i] == 1 ? full : empty) += 1;
        ASSERT_FLOAT_EQ(adapted.rgba[i], evenly.rgba[i]) << i / 4;
    }
    EXPECT_GT(full, 500);
    EXPECT_GT(empty, 1500);
    EXPECT_NE(adapted.pixel_samples.front(), adapted.pixel_samples[25 * 50 + 25]);
}

} // namespace
} // namespace blush::test::TEST_FILE
