// The sums for the error estimate, compared with a plain implementation, and for images beyond single precision.
#include "core/math.h"
#include "render/error/error_estimate.h"
#include "render/error/neighborhood_filter.h"
#include "render/film/edges/edge_pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace blush::TEST_FILE {
namespace {

// Two noisy halves of an image that gets brighter to the right; every seventh pixel has samples in one half only.
struct Halves {
    int width, height;
    double brightness;
    std::vector<Vec3d> a, b;

    Halves(int w, int h, double brightness_ = 1) : width(w), height(h), brightness(brightness_) {
        std::mt19937 bits(1);
        std::exponential_distribution<double> light(1);
        for (int i = 0; i < w * h; ++i)
            for (auto* half : {&a, &b}) half->push_back(Vec3d{light(bits), light(bits), light(bits)} * (brightness * (1 + i % w)));
    }
    bool known(int x, int y) const { return (y * width + x) % 7 != 3; }
    HalfBufferImage rows() const {
        return {width, height, [this](int y, float scale, HalfBufferRow& row) {
                    for (int x = 0; x < width; ++x) {
                        const size_t i = size_t(y * width + x);
                        const Vec3d u = a[i] * double(scale), v = (known(x, y) ? b[i] : a[i]) * double(scale);
                        const double ua[]{u.x, u.y, u.z}, va[]{v.x, v.y, v.z};
                        for (size_t c = 0; c < 3; ++c) {
                            row.a[c][x] = float(ua[c]);
                            row.b[c][x] = float(va[c]);
                            row.own[c][x] = float((ua[c] + va[c]) / 2);
                        }
                        row.weight_a[x] = 0.5f;
                        row.known[x] = known(x, y) ? 1.f : 0.f;
                        row.one_sample[x] = row.one_emission_sample[x] = known(x, y) ? 0.25f : 0.f;
                    }
                }};
    }
};

TEST(NeighborhoodFilter, AreMeansOfTheNeighbouringBlocks) {
    for (const auto& [w, h] : {std::pair{1, 1}, {1, 5}, {6, 1}, {2, 2}, {2, 7}, {5, 3}, {9, 11}}) {
        const Halves halves(w, h);
        std::vector<HalfBufferRow> rows{size_t(h), HalfBufferRow(w)};
        NeighborhoodFilter surroundings(w, h);
        NeighborhoodFilter::NeighborhoodMeans around{PixelRow(w), PixelRow(w)};
        const auto own = [&](int x, int y) { return double(rows[size_t(y)].own[0][x]); };
        const auto compare_row = [&](int y) {
            surroundings.means(0, y, rows[size_t(y)].own[0], around);
            for (int x = 0; x < w; ++x) {
                std::vector<double> means;
                for (const auto& [dx, dy] : {std::pair{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}) {
                    if (x + dx < 0 || x + dx >= w || y + dy < 0 || y + dy >= h) continue;
                    double sum = -own(x, y);
                    int count = -1;
                    for (int v = std::max(0, y + dy - 1); v <= std::min(h - 1, y + dy + 1); ++v)
                        for (int u = std::max(0, x + dx - 1); u <= std::min(w - 1, x + dx + 1); ++u, ++count) sum += own(u, v);
                    means.push_back(sum / count);
                }
                if (means.empty()) means.push_back(own(x, y));
                double mean = 0;
                for (const double m : means) mean += m / double(means.size());
                EXPECT_NEAR(around.mean[x], mean, 1e-5 * mean) << x << ", " << y << " of " << w << " x " << h;
                EXPECT_NEAR(around.darkest[x], *std::ranges::min_element(means), 1e-5 * mean)
                    << x << ", " << y << " of " << w << " x " << h;
            }
        };
        for (int y = 0; y < h; ++y) {
            halves.rows().load(y, 1, rows[size_t(y)]);
            surroundings.add_row(rows[size_t(y)].own, y);
            if (y >= 2) compare_row(y - 2);
        }
        for (int y = std::max(0, h - 2); y < h; ++y) compare_row(y);
    }
}

TEST(ErrorSums, MatchThePlainComputation) {
    const Halves halves(37, 23);
    const ErrorSums sums = sum_errors(halves.rows(), 0, 23);
    int64_t pixels = 0, pairs = 0;
    double squares = 0, fourths = 0, neighbours = 0;
    const auto difference = [&](int x, int y) { return (halves.a[size_t(y * 37 + x)] - halves.b[size_t(y * 37 + x)]) * 0.5; };
    for (int y = 0; y < 23; ++y)
        for (int x = 0; x < 37; ++x) {
            if (!halves.known(x, y)) continue;
            const Vec3d d = difference(x, y);
            ++pixels;
            squares += dot(d, d);
            fourths += dot(d, d) * dot(d, d);
            for (const auto& [u, v] : {std::pair{x - 1, y}, {x, y - 1}}) {
                if (u < 0 || v < 0 || !halves.known(u, v)) continue;
                ++pairs;
                neighbours += 4 * std::pow(dot(d, difference(u, v)), 2);
            }
        }
    EXPECT_EQ(sums.pixels, pixels);
    EXPECT_EQ(sums.pairs, pairs);
    EXPECT_NEAR(sums.absolute.squares, squares, 1e-5 * squares);
    EXPECT_NEAR(sums.absolute.fourths, fourths, 1e-5 * fourths);
    EXPECT_NEAR(sums.absolute.neighbour_products, neighbours, 1e-5 * neighbours);
    EXPECT_LE(sums.absolute.own_products, normal_product(1.0) * fourths * (1 + 1e-5));
    EXPECT_EQ(sums.unequal, 0);
}

// Nearly even halves around one pixel, whose first half has a firefly.
HalfBufferImage firefly(float around, float pixel, float in_firefly, float samples) {
    return {9, 9, [=](int y, float scale, HalfBufferRow& row) {
                for (int x = 0; x < 9; ++x) {
                    const bool middle = x == 4 && y == 4;
                    const float noise = (x + y) % 2 ? 0.01f : -0.01f;
                    for (size_t c = 0; c < 3; ++c) {
                        row.a[c][x] = scale * (middle ? in_firefly : around + noise);
                        row.b[c][x] = scale * (middle ? pixel : around - noise);
                        row.own[c][x] = (row.a[c][x] + row.b[c][x]) / 2;
                    }
                    row.weight_a[x] = 0.5f;
                    row.known[x] = 1;
                    row.one_sample[x] = row.one_emission_sample[x] = 1 / samples;
                }
            }};
}

// The darker half tells the value of a pixel with a firefly, if it has samples enough and does not differ too much from the
// neighbourhood: the divisor of relmse is its square, not that of the neighbourhood.
TEST(ErrorSums, DivideFirefliesByTheOtherHalf) {
    const auto relative = [](float around, float pixel, float in_firefly, float samples) {
        const double others = 3 * 80 * 1e-4 / (around * around + 0.01);
        return sum_errors(firefly(around, pixel, in_firefly, samples), 0, 9).relative.squares - others;
    };
    const auto divided_by = [](double value) { return 3 / (value * value + 0.01); }; // a half difference of 1
    EXPECT_NEAR(relative(1, 0.5f, 2.5f, 64), divided_by(0.5), 0.02);
    const double own_share = 0.2 / 24.2; // of a pixel in its neighbourhood
    // Too few samples; a half that is brighter than the neighbourhood.
    EXPECT_NEAR(relative(1, 0.5f, 2.5f, 8), divided_by(1 + 0.5 * own_share), 0.01);
    EXPECT_NEAR(relative(0.3f, 0.5f, 2.5f, 64), divided_by(0.3 + 1.2 * own_share), 0.05);
    // As at the edge of a lamp: by a third of the neighbourhood.
    EXPECT_NEAR(relative(30, 0, 60, 64), 900 * divided_by(10), 0.01);
    EXPECT_NEAR(relative(1, 0.995f, 1.005f, 64), 3 * 2.5e-5, 2e-5); // no firefly
}

// The half without the firefly tells how bright an outlier's pixel is, relative to the mean around it; pixels with samples in one half tell
// nothing.
TEST(ErrorSums, CompareTheOtherHalvesOfOutliersWithTheMeanAround) {
    const auto outliers = [](float pixel, float in_firefly) { return sum_errors(firefly(1, pixel, in_firefly, 64), 0, 9).outliers; };
    for (const float pixel : {0.5f, 1.f, 2.f}) {
        const ErrorSums::Outliers o = outliers(pixel, 4);
        EXPECT_NEAR(o.other_half / o.around, pixel, 0.01) << pixel;
        EXPECT_GT(o.loss, 0) << pixel;
    }
    for (const ErrorSums::Outliers& none : {outliers(0.9f, 1.1f), outliers(2, 2.5f)})
        EXPECT_EQ(none, ErrorSums::Outliers()); // below the ratio
    const HalfBufferImage unknown{9, 9, [](int y, float scale, HalfBufferRow& row) {
                                      firefly(1, 4, 4, 64).load(y, scale, row);
                                      if (y == 4) row.known[4] = 0;
                                  }};
    EXPECT_EQ(sum_errors(unknown, 0, 9).outliers, ErrorSums::Outliers());
}

TEST(ErrorSums, OfBandsAddUpToThoseOfTheImage) {
    const Halves halves(37, 50);
    const ErrorSums whole = sum_errors(halves.rows(), 0, 50);
    ErrorSums bands;
    for (int y = 0; y < 50; y += 7) bands.merge(sum_errors(halves.rows(), y, std::min(50, y + 7)));
    EXPECT_EQ(bands.pixels, whole.pixels);
    EXPECT_EQ(bands.pairs, whole.pairs);
    EXPECT_EQ(bands.largest, whole.largest);
    const auto near = [](double a, double b) { EXPECT_NEAR(a, b, 1e-12 * b); };
    near(bands.absolute.squares, whole.absolute.squares);
    near(bands.absolute.own_products, whole.absolute.own_products);
    near(bands.relative.squares, whole.relative.squares);
    near(bands.relative.neighbour_products, whole.relative.neighbour_products);
    near(bands.relative_high, whole.relative_high);
    ASSERT_GT(whole.outliers.around, 0);
    near(bands.outliers.loss, whole.outliers.loss);
    near(bands.outliers.loss_squares, whole.outliers.loss_squares);
    near(bands.outliers.other_half, whole.outliers.other_half);
    near(bands.outliers.around, whole.outliers.around);
}

// Fourth powers of values from 1e-30 to 1e30 overflow floats, but the estimate must scale with the image; relMSE where its 0.01
// is negligible, or dominates.
TEST(ErrorSums, ScaleBeyondSinglePrecision) {
    const auto estimate = [](double brightness) { return estimate_error(sum_errors(Halves(64, 64, brightness).rows(), 0, 64)); };
    const ErrorEstimate usual = estimate(1), bright = estimate(1e3), dark = estimate(1e-5);
    ASSERT_TRUE(usual.known && usual.rmse_known);
    for (const double brightness : {1e-30, 1e-12, 1e-6, 1e6, 1e12, 1e30}) {
        const ErrorEstimate e = estimate(brightness);
        EXPECT_TRUE(e.rmse_known) << brightness;
        EXPECT_NEAR(e.rmse / brightness, usual.rmse, 1e-5 * usual.rmse) << brightness;
        EXPECT_NEAR(e.rmse_high / brightness, usual.rmse_high, 1e-5 * usual.rmse_high) << brightness;
        if (brightness > 1) {
            EXPECT_NEAR(e.relmse, bright.relmse, 1e-3 * bright.relmse) << brightness;
        } else {
            EXPECT_NEAR(e.relmse / (brightness * brightness), dark.relmse * 1e10, 0.01 * dark.relmse * 1e10) << brightness;
        }
    }
}

// A square lamp of radiance 1000 in a noisy image of 32 x 32, with four samples a pixel; from `within` pixels inside its edge to `beyond`
// pixels outside it, 64 samples of the emission for each.
ErrorEstimate estimate_with_lamp(int lamp, int within, int beyond) {
    constexpr int side = 32;
    const Halves noise(side, side, 0.5);
    const int low = (side - lamp) / 2, high = low + lamp;
    const auto inside = [&](int x, int y, int margin) { return std::min(x, y) >= low - margin && std::max(x, y) < high + margin; };
    EdgePixels edges(side, side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            if (inside(x, y, beyond) && !inside(x, y, -within)) edges.add(x, y, highlight_samples);
    const HalfBufferImage image{side, side, [&](int y, float scale, HalfBufferRow& row) {
                                    noise.rows().load(y, scale, row);
                                    for (int x = 0; x < side; ++x) {
                                        row.one_emission_sample[x] = row.one_sample[x] / float(edges.fewest_near(x, y));
                                        if (!inside(x, y, 0)) continue;
                                        for (size_t c = 0; c < 3; ++c)
                                            for (ChannelRows* of : {&row.a, &row.b, &row.own}) (*of)[c][x] += 1000 * scale;
                                    }
                                }};
    return estimate_error(sum_errors(image, 0, side));
}

// One more sample of the lamp adds 250; where the pixels at the lamp and those around them take 64 samples of the emission for each, 4.
TEST(ErrorEstimate, IsKnownWherePixelsTakeManySamplesOfTheirLamp) {
    const ErrorEstimate around = estimate_with_lamp(3, 3, 1), within = estimate_with_lamp(3, 3, 0);
    EXPECT_TRUE(around.known);
    EXPECT_FALSE(around.rmse_known); // the halves of the lamp may agree by chance
    // The lamp may reach into a pixel beside it that takes one sample.
    EXPECT_FALSE(within.known || within.rmse_known);
    EXPECT_EQ(around.relmse, within.relmse);
}

// Pixels within a lamp, of which all samples meet it, need no more of them.
TEST(ErrorEstimate, IsKnownIfPixelsAtTheEdgesOfALampTakeManySamplesOfIt) {
    EXPECT_TRUE(estimate_with_lamp(10, 2, 1).known);
    EXPECT_FALSE(estimate_with_lamp(10, 0, 0).known);
    EXPECT_FALSE(estimate_with_lamp(10, 0, 1).known); // the edge may be within the lamp's pixels
}

// Rare light, as caustics are found by paths that hardly ever meet a lamp: with it the pixels of every eighth column are four times as
// bright as the others, or all pixels have the same share of it. 32 samples a half.
class RareLight {
public:
    enum class Where { in_lines, everywhere };
    static constexpr int side = 96;
    static constexpr double around = 0.1;

    RareLight(Where where, uint32_t seed) : where_(where) {
        std::mt19937 bits(seed);
        std::exponential_distribution<double> value(1);
        std::normal_distribution<double> noise(0, 0.01);
        for (int i = 0; i < side * side; ++i)
            for (auto& half : halves_) {
                const double rare = truth(i) - around, mean_value = 10; // of one sample
                std::poisson_distribution<int> count(samples * rare / mean_value);
                double sum = 0;
                for (int n = count(bits); n > 0; --n) sum += mean_value * value(bits);
                half.push_back(float(around + noise(bits) + sum / samples));
            }
    }
    ErrorEstimate estimate() const {
        const HalfBufferImage image{side, side, [&](int y, float scale, HalfBufferRow& row) {
                                        for (int x = 0; x < side; ++x) {
                                            const size_t i = size_t(y * side + x);
                                            for (size_t c = 0; c < 3; ++c) {
                                                row.a[c][x] = scale * halves_[0][i];
                                                row.b[c][x] = scale * halves_[1][i];
                                                row.own[c][x] = (row.a[c][x] + row.b[c][x]) / 2;
                                            }
                                            row.weight_a[x] = 0.5f;
                                            row.known[x] = 1;
                                            row.one_sample[x] = row.one_emission_sample[x] = 0.5f / samples;
                                        }
                                    }};
        return estimate_error(sum_errors(image, 0, side));
    }
    double relmse() const {
        double sum = 0;
        for (size_t i = 0; i < halves_[0].size(); ++i) {
            const double t = truth(int(i)), error = (double(halves_[0][i]) + double(halves_[1][i])) / 2 - t;
            sum += error * error / (t * t + 0.01);
        }
        return sum / double(halves_[0].size());
    }

private:
    static constexpr int samples = 32;
    double truth(int pixel) const {
        if (where_ == Where::everywhere) return around + 0.15;
        return pixel % side % 8 == 4 ? 4 * around : around;
    }

    Where where_;
    std::vector<float> halves_[2];
};

// Lines that are narrower than the neighbourhood are brighter than the mean around them; pixels with rare fireflies need not be. The other
// halves of outliers tell which.
TEST(ErrorEstimate, IntervalsHoldForRareLightInLinesAndEverywhere) {
    for (const auto where : {RareLight::Where::in_lines, RareLight::Where::everywhere}) {
        int known = 0, covered = 0;
        constexpr int runs = 100;
        for (uint32_t seed = 0; seed < runs; ++seed) {
            const RareLight image(where, seed);
            const ErrorEstimate e = image.estimate();
            if (!e.known) continue;
            ++known;
            covered += e.low <= image.relmse() && image.relmse() <= e.high;
        }
        EXPECT_GT(known, runs / 2);
        // 95 %, less three standard errors of their binomial distribution.
        EXPECT_GE(covered, 0.95 * known - 3 * std::sqrt(0.95 * 0.05 * known))
            << (where == RareLight::Where::in_lines ? "lines" : "everywhere");
    }
}

// 16 times the variance is 4 times the width, on a logarithmic scale; the uncertainty of relmse's divisor is separate.
TEST(ErrorEstimate, CorrelatedPixelErrorsWidenTheInterval) {
    ErrorSums sums;
    sums.pixels = 1'000'000;
    sums.absolute.squares = sums.relative.squares = sums.relative_high = 1;
    sums.absolute.own_products = sums.relative.own_products = 1e-4;
    const ErrorEstimate one = estimate_error(sums), shared = estimate_error(sums, 16);
    EXPECT_EQ(shared.relmse, one.relmse);
    const auto width = [](double high, double low) { return std::log(high / low); };
    EXPECT_NEAR(width(shared.high, shared.low) / width(one.high, one.low), 4, 0.01);
    EXPECT_NEAR(width(shared.rmse_high, shared.rmse_low) / width(one.rmse_high, one.rmse_low), 4, 0.01);
    sums.relative_high = 2;
    EXPECT_LT(width(estimate_error(sums, 16).high, estimate_error(sums, 16).low),
              4 * width(estimate_error(sums).high, estimate_error(sums).low));
}

} // namespace
} // namespace blush::TEST_FILE
