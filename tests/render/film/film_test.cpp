// The film's arithmetic with hand-made samples: sums that do not drift, invalid samples, and a valid error estimate.
#include "render/film/film.h"
#include "tests/support/statistics.h"

#include <memory>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

// A film of width x height and a tile to fill it with.
struct Fixture {
    Film film;
    std::unique_ptr<TileScratch> tile = std::make_unique<TileScratch>();
    Film::Diagnose diagnose;
    Workers workers{1};
    int width, height;

    Fixture(int w, int h, const PlaneSet& planes = {}, bool transparent = false) : width(w), height(h) {
        film.reset({w, h, planes, transparent});
        if (film.needs_first_hits()) tile->first = std::make_unique<FirstHitColumns>();
    }
    // value(x, y, sample): grey, for samples [first, first + count) of every pixel.
    template <class Value> void add(int64_t first, int count, Value value) {
        int slot = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int s = 0; s < count; ++s, ++slot) tile->r[slot] = tile->g[slot] = tile->b[slot] = float(value(x, y, first + s));
        film.add({0, 0, width, height, first, count}, *tile, 42, diagnose);
    }
    Frame resolve() {
        Frame frame;
        film.resolve(frame, workers);
        frame.error = film.estimate_error(workers);
        return frame;
    }
};

TEST(Film, AMillionSamplesDoNotDrift) {
    Fixture f(1, 1);
    const auto value = [](int, int, int64_t s) { return s % 2 ? 0.1f : 3000.7f; };
    for (int64_t first = 0; first < 1'000'000; first += 4000) f.add(first, 4000, value);
    EXPECT_EQ(f.resolve().rgba[0], float((double(0.1f) + double(3000.7f)) / 2));
}

TEST(Film, DropsCountsAndRecordsInvalidSamples) {
    Fixture f(4, 3);
    const auto value = [](int x, int y, int64_t s) {
        if (x == 1 && y == 2 && s == 3) return std::numeric_limits<float>::quiet_NaN();
        if (x == 0 && y == 0 && s == 5) return std::numeric_limits<float>::infinity();
        if (x == 3 && y == 1 && s == 3) return -1e-3f;
        return float(s);
    };
    f.add(0, 8, value);
    const Frame frame = f.resolve();
    EXPECT_EQ(frame.health.nan, 1);
    EXPECT_EQ(frame.health.infinite, 1);
    EXPECT_EQ(frame.health.negative, 1);
    EXPECT_EQ(frame.health.dropped(), 3);
    using Cause = BadSample::Cause;
    const std::vector<BadSample> expected = {{Cause::negative, 3, 1, 3, 42}, {Cause::nan, 1, 2, 3, 42}, {Cause::infinite, 0, 0, 5, 42}};
    EXPECT_EQ(frame.health.first, expected);
    // The mean is that of the others.
    EXPECT_FLOAT_EQ(frame.rgba[4 * 5], 28.f / 8);
    EXPECT_FLOAT_EQ(frame.rgba[4 * 9], 25.f / 7);
    EXPECT_FLOAT_EQ(frame.rgba[0], 23.f / 7);
}

TEST(Film, KeepsDiagnosesAndAMapOfDroppedSamples) {
    Fixture f(3, 2);
    f.diagnose = [](int x, int y, int64_t sample) {
        return Fault{Fault::Kind::zero_pdf, Fault::Place::bsdf_eval, x + 10 * y + 100 * int(sample)};
    };
    f.add(0, 2, [](int x, int y, int64_t s) { return x == 2 && y == 1 && s == 1 ? NAN : 1.f; });
    const Health health = f.resolve().health;
    ASSERT_EQ(health.first.size(), 1u);
    EXPECT_EQ(health.first[0].fault, (Fault{Fault::Kind::zero_pdf, Fault::Place::bsdf_eval, 112}));
    EXPECT_EQ(health.count(Fault::Kind::zero_pdf, Fault::Place::bsdf_eval), 1);
    EXPECT_EQ(health.dropped_map, (std::vector<uint32_t>{0, 0, 0, 0, 0, 1}));
    Fixture sound(3, 2);
    sound.add(0, 2, [](int, int, int64_t) { return 1; });
    EXPECT_TRUE(sound.resolve().health.dropped_map.empty()) << "not allocated if unused";
}

TEST(Film, RecordsTheFirstHundredAndCountsAll) {
    Fixture f(16, 16);
    f.add(8, 8, [](int, int, int64_t) { return -INFINITY; });
    f.add(0, 8, [](int, int, int64_t) { return NAN; });
    const Frame frame = f.resolve();
    EXPECT_EQ(frame.health.nan, 2048);
    EXPECT_EQ(frame.health.infinite, 2048);
    ASSERT_EQ(frame.health.first.size(), 100u);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(frame.health.first[size_t(i)], (BadSample{BadSample::Cause::nan, i % 16, i / 16, 0, 42}));
    for (const float value : frame.rgba) EXPECT_TRUE(std::isfinite(value));
    EXPECT_FALSE(frame.error.known);
}

TEST(Film, ClearResetsHealth) {
    Fixture f(8, 8);
    f.add(0, 2, [](int, int, int64_t) { return NAN; });
    f.add(2, 2, [](int, int, int64_t) { return 5; });
    f.film.clear();
    f.add(0, 2, [](int, int, int64_t) { return 1; });
    const Frame frame = f.resolve();
    EXPECT_EQ(frame.health.dropped(), 0);
    EXPECT_TRUE(frame.health.first.empty());
    EXPECT_EQ(frame.rgba[0], 1);
}

TEST(Film, CoverageIsTheShareOfSamplesThatHit) {
    Fixture f(2, 1, {}, true);
    for (int slot = 0; slot < 16; ++slot) f.tile->first->material[slot] = slot < 8 ? 0 : slot < 14 ? -1 : 3;
    f.add(0, 8, [](int, int, int64_t) { return 1; });
    const Frame frame = f.resolve();
    EXPECT_EQ(frame.rgba[3], 1);
    EXPECT_EQ(frame.rgba[7], 0.25f);
}

// ---- the error estimate

struct Noise {
    std::mt19937 bits;
    std::normal_distribution<double> normal{0, 1};
    explicit Noise(uint32_t seed) : bits(seed) {}
    double operator()() { return normal(bits); }
};
constexpr double level = 4, deviation = 0.5;
double noisy(Noise& noise) { return std::max(0.0, level + deviation * noise()); }
TEST(ErrorEstimate, IsUnknownBeforeBothHalvesHoldSamples) {
    Fixture f(16, 16);
    Noise noise(1);
    EXPECT_FALSE(f.resolve().error.known);
    f.add(0, 1, [&](int, int, int64_t) { return noisy(noise); });
    EXPECT_FALSE(f.resolve().error.known);
    EXPECT_TRUE(f.film.standard_error().empty());
    f.add(1, 1, [&](int, int, int64_t) { return noisy(noise); });
    EXPECT_TRUE(f.resolve().error.known);
    EXPECT_EQ(f.film.standard_error().size(), 256u);
}

// The error of this very image, which is known here. relMSE's interval
// also accounts for its divisor, so its coverage may be higher.
TEST(ErrorEstimate, IsUnbiasedAndItsIntervalHasNominalCoverage) {
    constexpr int64_t runs = 1000;
    for (const int samples : {2, 8}) {
        Noise noise{uint32_t(samples)};
        Moments squares;
        int64_t inside = 0, rmse_inside = 0;
        for (int64_t run = 0; run < runs; ++run) {
            Fixture f(16, 16);
            f.add(0, samples, [&](int, int, int64_t) { return noisy(noise); });
            const Frame frame = f.resolve();
            const ErrorEstimate& e = frame.error;
            Moments actual;
            for (size_t i = 0; i < frame.rgba.size(); i += 4) actual.add(std::pow(double(frame.rgba[i]) - level, 2));
            const double mse = actual.mean, relmse = mse / (level * level + 0.01);
            squares.add(e.rmse * e.rmse);
            inside += e.low <= relmse && relmse <= e.high;
            rmse_inside += e.rmse_low <= std::sqrt(mse) && std::sqrt(mse) <= e.rmse_high;
        }
        EXPECT_TRUE(z_test(squares, deviation * deviation / samples, sidak(significance, 2))) << samples;
        const double sigma = std::sqrt(0.95 * 0.05 / double(runs));
        EXPECT_NEAR(double(rmse_inside) / double(runs), 0.95, 0.02 + 3 * sigma) << samples;
        EXPECT_GT(double(inside) / double(runs), 0.93 - 3 * sigma) << samples;
    }
}

// A single pixel that carries all of the error gives no estimate of how large it may be.
TEST(ErrorEstimate, IsUnknownIfOnePixelCarriesTheError) {
    Fixture f(16, 16);
    f.add(0, 2, [&](int x, int y, int64_t sample) { return x == 8 && y == 8 && sample == 0 ? 1000.0 : 1.0; });
    EXPECT_FALSE(f.resolve().error.known);
    EXPECT_FALSE(f.resolve().error.rmse_known);
}

TEST(ErrorEstimate, IsZeroForAnImageWithoutNoise) {
    Fixture f(16, 16);
    f.add(0, 2, [&](int, int, int64_t) { return 1.0; });
    const ErrorEstimate e = f.resolve().error;
    EXPECT_TRUE(e.known && e.rmse_known);
    EXPECT_EQ(e.high, 0);
    EXPECT_EQ(e.rmse_high, 0);
}

TEST(HalfDifference, HasTheStandardErrorAsItsSizeAndASign) {
    Fixture f(16, 16, {.half_difference = true});
    Noise noise(3);
    f.add(0, 1, [&](int, int, int64_t) { return noisy(noise); });
    EXPECT_TRUE(f.resolve().half_difference.empty()) << "one half is empty";
    f.add(1, 6, [&](int, int, int64_t) { return noisy(noise); });
    const std::vector<Vec3> halves = f.resolve().half_difference, errors = f.film.standard_error();
    ASSERT_EQ(halves.size(), errors.size());
    int64_t positive = 0;
    for (size_t i = 0; i < halves.size(); ++i) {
        ASSERT_EQ(std::abs(halves[i].x), errors[i].x);
        ASSERT_EQ(std::abs(halves[i].z), errors[i].z);
        positive += halves[i].x > 0;
    }
    // Either sign has a chance of 1/2: four standard deviations of 8.
    EXPECT_NEAR(double(positive), 128, 4 * 8);
}

TEST(ErrorEstimate, StandardErrorIsThatOfTheMean) {
    for (const int samples : {2, 5, 16}) {
        Fixture f(16, 16);
        Noise noise{uint32_t(10 + samples)};
        f.add(0, samples, [&](int, int, int64_t) { return noisy(noise); });
        Moments squares;
        for (const Vec3& e : f.film.standard_error()) squares.add(double(e.x) * double(e.x));
        EXPECT_TRUE(z_test(squares, deviation * deviation / samples, sidak(significance, 3))) << samples;
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
