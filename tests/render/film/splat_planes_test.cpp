// Light paths in the film: a half of a pixel is the mean of its samples plus its splats per pass, for every reader of the film.
#include "render/film/splat_planes.h"

#include "render/film/film.h"
#include "render/film/film_merger.h"
#include "render/film/film_state.h"
#include "render/film/pilot_variance.h"
#include "tests/support/statistics.h"

#include <limits>
#include <memory>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
using Splats = std::vector<Splat>;

Splat grey(int pixel, float radiance) { return {pixel, {radiance, radiance, radiance}}; }

FilmSize with_light_paths(int width, int height, bool adaptive = false) {
    return {.width = width, .height = height, .adaptive = adaptive, .light_paths = true};
}

struct Fixture {
    Film film;
    std::unique_ptr<TileScratch> tile = std::make_unique<TileScratch>();
    Workers workers{1};

    explicit Fixture(const FilmSize& size, const Clamp& clamp = {}) { film.reset(size, clamp); }
    // Grey samples value(pixel, sample) of every pixel: first, first + stride, ...
    template <class Value> void add(int64_t first, int count, int stride, Value value) {
        const TileJob job{0, 0, film.width(), film.height(), first, count, stride};
        for (int slot = 0; slot < job.paths(); ++slot)
            tile->r[slot] = tile->g[slot] = tile->b[slot] = float(value(slot / count, job.sample(slot % count)));
        film.add(job, *tile, 42);
    }
    void add_pass(int64_t pass, const Splats& splats, double traced = 1) {
        const std::span<const Splat> list = splats;
        film.add_pass(pass, {&list, 1}, workers, 0, traced);
    }
    Frame resolve() const {
        Frame frame;
        film.resolve(frame, workers);
        frame.error = film.estimate_error(workers);
        return frame;
    }
};

// Two pixels with more even than odd samples, of means 2 and 4, and four passes that reach only the second pixel.
void fill_two_pixels(Fixture& f) {
    f.add(0, 4, 2, [](int, int64_t sample) { return sample == 0 ? 1 : sample == 4 ? 3 : 2; });
    f.add(1, 2, 2, [](int, int64_t sample) { return sample == 1 ? 6 : 2; });
    f.add_pass(0, {grey(1, 8)});
    f.add_pass(1, {grey(1, 3), grey(1, 1)});
    f.add_pass(2, {grey(1, 12)});
    f.add_pass(3, {});
}

TEST(SplatPlanes, HalvesAreMeansOfSamplesPlusSplatsPerPass) {
    for (const bool adaptive : {false, true}) {
        Fixture f(with_light_paths(2, 1, adaptive));
        fill_two_pixels(f);
        const PixelHalfBuffers plain = f.film.half_buffers(0), lit = f.film.half_buffers(1);
        ASSERT_TRUE(plain.known && lit.known);
        EXPECT_EQ(plain.a.x, 2);
        EXPECT_EQ(plain.b.x, 4);
        EXPECT_EQ(lit.a.x, 2 + 20 / 2);
        EXPECT_EQ(lit.b.x, 4 + 4 / 2);
        EXPECT_EQ(f.film.sum(1, 0).y, 4 * 12);
        EXPECT_EQ(f.film.sum(1, 1).z, 2 * 6);
        const double weight = adaptive ? 0.5 : 4 / 6.0;
        EXPECT_DOUBLE_EQ(lit.weight_a, weight);
        const Frame frame = f.resolve();
        EXPECT_FLOAT_EQ(frame.rgba[0], float(weight * 2 + (1 - weight) * 4));
        EXPECT_FLOAT_EQ(frame.rgba[4], float(weight * 12 + (1 - weight) * 6));
        const std::vector<Vec3> errors = f.film.standard_error();
        EXPECT_FLOAT_EQ(errors[1].x, float(6 * std::sqrt(weight * (1 - weight))));
    }
}

// The usual case: as many passes as samples, in both halves.
TEST(SplatPlanes, ImageIsMeanOfSamplesPlusSplatsPerPass) {
    Fixture f(with_light_paths(1, 1));
    f.add(0, 3, 1, [](int, int64_t sample) { return sample; });
    for (int pass = 0; pass < 3; ++pass) f.add_pass(pass, {grey(0, float(1 << pass))});
    EXPECT_EQ(f.film.passes(), (std::array<int64_t, 2>{2, 1}));
    EXPECT_FLOAT_EQ(f.resolve().rgba[0], 1 + 7 / 3.f);
}

TEST(SplatPlanes, APartOfAPassStandsForAllOfIt) {
    Fixture f(with_light_paths(1, 1));
    f.add(0, 1, 1, [](int, int64_t) { return 2; });
    f.add_pass(0, {grey(0, 3)}, 0.25);
    EXPECT_EQ(f.resolve().rgba[0], 2 + 12);
    f.add_pass(0, {grey(0, 5)});
    EXPECT_EQ(f.film.passes(), (std::array<int64_t, 2>{1, 0}));
    EXPECT_EQ(f.resolve().rgba[0], 2 + 8);
    f.add(1, 1, 1, [](int, int64_t) { return 2; });
    f.add_pass(1, {grey(0, 4)});
    f.add(2, 1, 1, [](int, int64_t) { return 2; });
    f.add_pass(2, {grey(0, 6)});
    EXPECT_EQ(f.film.passes(), (std::array<int64_t, 2>{2, 1}));
    EXPECT_FLOAT_EQ(f.resolve().rgba[0], 2 + (8 + 4 + 6) / 3.f);
}

TEST(SplatPlanes, AHalfWithoutPassesHasNoSplats) {
    Fixture f(with_light_paths(1, 1));
    f.add(0, 2, 1, [](int, int64_t) { return 2; });
    EXPECT_EQ(f.resolve().rgba[0], 2);
    f.add_pass(1, {grey(0, 3)});
    EXPECT_EQ(f.film.sum(0, 0).x, 2);
    EXPECT_EQ(f.film.sum(0, 1).x, 5);
}

// ---- passes

// Random splats over a film, some of them invalid. So different that the order of a sum shows in its rounding.
Splats random_splats(std::mt19937& bits, int pixels, int count) {
    Splats splats;
    std::exponential_distribution<float> radiance;
    for (int i = 0; i < count; ++i) {
        const int32_t pixel = int32_t(bits() % uint32_t(pixels));
        const float scale = std::exp2(float(bits() % 64) - 32);
        splats.push_back({pixel, {scale * radiance(bits), scale * radiance(bits), scale * radiance(bits)}});
        if (i % 97 == 0) splats.back().radiance.y = std::array{nan, inf, -1.f}[size_t(i / 97 % 3)];
    }
    return splats;
}

TEST(SplatPlanes, PassesDependNeitherOnThreadsNorOnLists) {
    constexpr int width = 13, height = 11, count = 5000;
    const auto trace = [&](unsigned threads, size_t lists) {
        const Workers workers(threads);
        std::mt19937 bits(7);
        Film film;
        film.reset(with_light_paths(width, height));
        for (int64_t pass = 0; pass < 3; ++pass) {
            const Splats splats = random_splats(bits, width * height, count);
            std::vector<std::span<const Splat>> split{{}};
            for (size_t k = 0; k < lists; ++k) {
                const size_t from = count * k * k / (lists * lists), to = count * (k + 1) * (k + 1) / (lists * lists);
                split.push_back(std::span(splats).subspan(from, to - from));
            }
            film.add_pass(pass, split, workers, 42);
        }
        return save_film(film);
    };
    // In order, one by one.
    std::vector<ExactSum3> expected(2 * width * height);
    std::mt19937 bits(7);
    for (size_t pass = 0; pass < 3; ++pass)
        for (const Splat& s : random_splats(bits, width * height, count)) {
            if (!(s.radiance.y >= 0 && s.radiance.y < inf)) continue;
            expected[2 * size_t(s.pixel) + pass % 2].add({double(s.radiance.x), double(s.radiance.y), double(s.radiance.z)});
        }
    const FilmState one = trace(1, 1);
    for (size_t i = 0; i < width * height; ++i) {
        ASSERT_EQ(one.find("even.splats.R")->sum(i), expected[2 * i].x.value());
        ASSERT_EQ(one.find("odd.splats.B")->sum(i), expected[2 * i + 1].z.value());
    }
    EXPECT_EQ(one.health.dropped(), 3 * 52);
    for (const unsigned threads : {1u, 2u, 3u, 8u, 200u})
        for (const size_t lists : {1, 2, 64}) {
            const FilmState other = trace(threads, lists);
            EXPECT_EQ(other.planes, one.planes) << threads << " threads, " << lists << " lists";
            EXPECT_EQ(other.passes, one.passes);
            EXPECT_EQ(other.health.first, one.health.first) << threads << " threads, " << lists << " lists";
            EXPECT_EQ(other.health.dropped_map, one.health.dropped_map);
        }
}

TEST(SplatPlanes, DropsCountsAndRecordsInvalidSplats) {
    Fixture f(with_light_paths(3, 2));
    f.add(0, 2, 1, [](int, int64_t) { return 1; });
    f.add_pass(0, {{4, {1, -1e-3f, 1}}, {4, {nan, -1, inf}}, {4, {2, 2, 2}}, {1, {1, inf, 1}}});
    f.add_pass(1, {{5, {1, 1, nan}}});
    const Frame frame = f.resolve();
    EXPECT_EQ(frame.health.nan, 2);
    EXPECT_EQ(frame.health.infinite, 1);
    EXPECT_EQ(frame.health.negative, 1);
    using Cause = BadSample::Cause;
    const auto fault = [](Fault::Kind kind) { return Fault{kind, Fault::Place::light_path, 0}; };
    const std::vector<BadSample> expected = {{Cause::infinite, 1, 0, 0, 0, fault(Fault::Kind::infinite)},
                                             {Cause::nan, 1, 1, 0, 0, fault(Fault::Kind::nan)},
                                             {Cause::negative, 1, 1, 0, 0, fault(Fault::Kind::negative)},
                                             {Cause::nan, 2, 1, 1, 0, fault(Fault::Kind::nan)}};
    EXPECT_EQ(frame.health.first, expected);
    EXPECT_EQ(frame.health.dropped_map, (std::vector<uint32_t>{0, 1, 0, 0, 2, 1}));
    EXPECT_EQ(describe(expected[1]), "nan at light path, vertex 0: pixel 1,1 sample 0");
    EXPECT_EQ(frame.rgba[4 * 4], 1 + 2 / 2.f) << "the other splat of the pixel";
    EXPECT_EQ(frame.rgba[4 * 5], 1);
}

// ---- readers

// The list of fireflies must not depend on how many passes are added between samples.
TEST(SplatPlanes, FirefliesAreJudgedByTheSamplesAlone) {
    const auto fireflies = [](bool lit) {
        Fixture f(with_light_paths(1, 1));
        f.add(0, 2, 1, [](int, int64_t) { return 1; });
        for (int pass = 0; pass < 2 && lit; ++pass) f.add_pass(pass, {grey(0, 100)});
        f.add(2, 2, 1, [](int, int64_t) { return 40; });
        return f.film.health().fireflies;
    };
    EXPECT_FALSE(fireflies(false).empty());
    EXPECT_EQ(fireflies(true), fireflies(false));
}

TEST(SplatPlanes, ShareOfClampedLightCountsSplats) {
    Fixture f(with_light_paths(1, 1), {4, true});
    f.add(0, 2, 1, [](int, int64_t) { return 5; });
    for (int pass = 0; pass < 2; ++pass) f.add_pass(pass, {grey(0, 5)});
    const Frame frame = f.resolve();
    EXPECT_EQ(frame.rgba[0], 9);
    EXPECT_DOUBLE_EQ(frame.clamp.share, 0.1);
}

// The pilot of adaptive sampling cannot tell whether light came as samples or as splats.
TEST(SplatPlanes, PilotMeasuresTheirNoise) {
    constexpr int size = 2 * SampleAllocation::tile_size;
    constexpr auto value = [](int pixel, int64_t sample) {
        return float(std::minstd_rand(uint32_t(pixel) * 16 + uint32_t(sample) + 1)() % 64) / 16;
    };
    const auto measure = [&](bool splats) {
        Fixture f(with_light_paths(size, size, true));
        PilotVariance noise;
        for (int64_t i = 0; i < SampleAllocation::pilot_samples; ++i) {
            if (i == SampleAllocation::pilot_samples / 2) noise.mark(f.film);
            f.add(i, 1, 1, [&](int pixel, int64_t sample) { return splats ? 0 : value(pixel, sample); });
            Splats of_pass;
            for (int pixel = 0; pixel < size * size && splats; ++pixel) of_pass.push_back(grey(pixel, value(pixel, i)));
            f.add_pass(i, of_pass);
        }
        return noise.measure(f.film);
    };
    const auto from_samples = measure(false), from_splats = measure(true);
    EXPECT_GT(from_samples[0][0], 0);
    EXPECT_EQ(from_samples, from_splats);
}

TEST(SplatPlanes, RenewalOfFirstSampleKeepsThem) {
    Fixture f(with_light_paths(2, 1));
    fill_two_pixels(f);
    EdgePixels edge(2, 1);
    edge.add(1, 0);
    f.tile->r[1] = f.tile->g[1] = f.tile->b[1] = 0.5f;
    f.film.add_to_first_sample({0, 0, 2, 1, 0, 1}, *f.tile, edge, -1);
    EXPECT_EQ(f.film.sum(1, 0).x, 4 * 12 - 0.5);
    EXPECT_EQ(f.film.sum(0, 0).x, 8);
}

TEST(SplatPlanes, ClearRemovesThemAndFewerPlanesDoNot) {
    Fixture f(FilmSize{.width = 1, .height = 1, .planes = {.depth = true}, .light_paths = true});
    f.tile->first = std::make_unique<FirstHitColumns>();
    const auto one = [](int, int64_t) { return 1; };
    f.add(0, 1, 1, one);
    f.add_pass(0, {grey(0, 2)});
    f.film.keep_only({});
    EXPECT_EQ(f.resolve().rgba[0], 3);
    f.film.clear();
    EXPECT_TRUE(f.film.has_light_paths());
    EXPECT_EQ(f.film.passes(), (std::array<int64_t, 2>{}));
    f.add(0, 1, 1, one);
    EXPECT_EQ(f.resolve().rgba[0], 1);
    f.add_pass(0, {});
    EXPECT_EQ(f.resolve().rgba[0], 1);
    f.film.reset({});
    EXPECT_FALSE(f.film.has_light_paths());
}

TEST(SplatPlanes, AreNotAllocatedWithoutLightPaths) {
    Film without, with;
    without.reset({.width = 8, .height = 4});
    with.reset(with_light_paths(8, 4));
    EXPECT_EQ(with.memory_bytes(), without.memory_bytes() + 8 * 4 * SplatPlanes::bytes_per_pixel(0, 0));
    EXPECT_FALSE(without.has_light_paths());
    const FilmState state = save_film(without);
    EXPECT_FALSE(state.find("even.splats.R") || film_size(state).light_paths);
}

// ---- states

// Samples and passes [first, first + count) of a film of 5 x 3 pixels, of values that add up without rounding.
FilmState traced(int64_t first, int64_t count, bool adaptive = false) {
    Fixture f(with_light_paths(5, 3, adaptive));
    for (int64_t i = first; i < first + count; ++i) {
        f.add(i, 1, 1, [](int pixel, int64_t sample) { return float((pixel * 3 + sample * 5) % 11) / 8; });
        Splats splats;
        for (int k = 0; k < 40; ++k) splats.push_back(grey(int((k * k + i) % 15), float((k + 3 * i) % 13) / 4));
        splats.push_back(grey(int(i % 15), nan));
        f.add_pass(i, splats);
    }
    FilmState state = save_film(f.film);
    state.first_sample = first;
    state.samples = count;
    return state;
}

TEST(SplatPlanes, StatesKeepThem) {
    for (const bool adaptive : {false, true}) {
        const FilmState state = traced(0, 5, adaptive);
        EXPECT_EQ(state.passes, (std::array<int64_t, 2>{3, 2}));
        FilmSize size = film_size(state);
        EXPECT_TRUE(size.light_paths);
        size.adaptive = adaptive;
        Fixture f(size);
        ASSERT_TRUE(load_film(f.film, state));
        const FilmState again = save_film(f.film);
        EXPECT_EQ(again.planes, state.planes);
        EXPECT_EQ(again.passes, state.passes);
        EXPECT_EQ(again.health.first, state.health.first);
        const Result<ResolvedFilm> resolved = resolve_film(state, {.adaptive = adaptive}, 1);
        ASSERT_TRUE(resolved);
        EXPECT_EQ(resolved->frame.rgba, f.resolve().rgba);
        const double even = f.film.sum(6, 0).x / 3, splats = state.find("even.splats.R")->sum(6);
        EXPECT_GT(splats, 0);
        EXPECT_DOUBLE_EQ(even, state.find("even.R")->sum(6) / 3 + splats / 3);
    }
}

TEST(SplatPlanes, MergedStatesAreThatOfOneFilm) {
    const FilmState whole = traced(0, 9);
    for (const int64_t split : {1, 4}) {
        const Result<FilmState> merged = merge_films(traced(0, split), traced(split, 9 - split), {});
        ASSERT_TRUE(merged);
        EXPECT_EQ(merged->planes, whole.planes);
        EXPECT_EQ(merged->passes, whole.passes);
        EXPECT_EQ(merged->health.first, whole.health.first);
        EXPECT_EQ(resolve_film(*merged, {}, 1)->frame.rgba, resolve_film(whole, {}, 1)->frame.rgba);
    }
}

// Their samples have other MIS weights.
TEST(SplatPlanes, StatesWithAndWithoutThemDoNotMix) {
    const FilmState with = traced(0, 2);
    FilmState without = traced(2, 2);
    std::erase_if(without.planes, [](const LosslessPlane& p) { return p.name.find("splats") != std::string::npos; });
    without.passes = {};
    const auto what = [](const auto& result) { return result ? std::string("accepted") : result.error().what; };
    EXPECT_EQ(what(merge_films(with, without, {})), "saved samples without light paths do not fit an image with them");
    without.first_sample = 0;
    FilmState later = traced(2, 2);
    EXPECT_EQ(what(merge_films(without, later, {})), "saved samples with light paths do not fit an image without them");
    Film film;
    film.reset({.width = 5, .height = 3});
    EXPECT_EQ(what(load_film(film, with)), "saved samples with light paths do not fit an image without them");
    // And a plane may not be missing.
    std::erase_if(later.planes, [](const LosslessPlane& p) { return p.name == "odd.splats.G"; });
    EXPECT_EQ(what(merge_films(with, later, {})), "the saved samples lack the plane \"odd.splats.G\"");
}

// ---- the error estimate

// All noise is in the splats: in every pass each light path reaches a random pixel, with exponential radiance. Nominal are 95 %;
// the allowance is that of the estimate for samples (film_test.cpp). relMSE's interval also accounts for its divisor.
TEST(SplatPlanes, ErrorEstimateHasNominalCoverage) {
    constexpr int size = 16, pixels = size * size, paths_per_pixel = 4;
    constexpr double camera = 1, level = camera + paths_per_pixel, variance = 2.0 * paths_per_pixel; // of a pass
    constexpr int64_t runs = 1000;
    for (const auto& [adaptive, passes] : {std::pair{false, 2}, {false, 8}, {true, 4}}) {
        std::mt19937 bits{uint32_t(passes)};
        std::exponential_distribution<float> radiance;
        Fixture f(with_light_paths(size, size, adaptive));
        Moments squares;
        int64_t inside = 0, rmse_inside = 0;
        for (int64_t run = 0; run < runs; ++run) {
            f.film.clear();
            // Adaptive: the halves differ in samples, not in passes.
            f.add(0, passes / 2, 2, [](int, int64_t) { return camera; });
            f.add(1, adaptive ? 2 * passes : passes / 2, 2, [](int, int64_t) { return camera; });
            for (int pass = 0; pass < passes; ++pass) {
                Splats splats;
                for (int k = 0; k < paths_per_pixel * pixels; ++k) splats.push_back(grey(int(bits() % pixels), radiance(bits)));
                f.add_pass(pass, splats);
            }
            const Frame frame = f.resolve();
            const ErrorEstimate& e = frame.error;
            Moments actual;
            for (size_t i = 0; i < frame.rgba.size(); i += 4) actual.add(std::pow(double(frame.rgba[i]) - level, 2));
            const double mse = actual.mean, relmse = mse / (level * level + 0.01);
            squares.add(e.rmse * e.rmse);
            inside += e.low <= relmse && relmse <= e.high;
            rmse_inside += e.rmse_low <= std::sqrt(mse) && std::sqrt(mse) <= e.rmse_high;
        }
        EXPECT_TRUE(z_test(squares, variance / passes, sidak(significance, 3))) << passes;
        const double sigma = std::sqrt(0.95 * 0.05 / double(runs));
        EXPECT_NEAR(double(rmse_inside) / double(runs), 0.95, 0.02 + 3 * sigma) << passes;
        EXPECT_GT(double(inside) / double(runs), 0.93 - 3 * sigma) << passes;
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
