// What the learned adjoint says of a place and of a pixel, from trials whose distribution is known.
#include "render/roulette/adjoint_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

constexpr int side = 16;
constexpr float level = 4; // nits of every pixel

// Half of the samples have twice the level, the others none: the relative variance is 1, of the population.
AdjointImage checkered(float rays_per_sample) {
    AdjointImage image{side, side, 2, {}, double(rays_per_sample) * side * side * 2};
    for (int k = 0; k < side * side; ++k)
        for (const float v : {0.f, 2 * level}) image.luminance.push_back(v);
    return image;
}

// Two rooms a hundred metres apart. Light of the left one: 0 or 2 * mean, of the right one always `bright`.
struct Rooms {
    float mean = 3, bright = 10, rays = 5;
    std::vector<ContinuationTrial> trials(int count = 20000) const {
        std::mt19937 rng(1);
        std::uniform_real_distribution<float> u(0, 1);
        std::vector<ContinuationTrial> all;
        for (int k = 0; k < count; ++k) {
            const bool left = k % 2 == 0;
            const Vec3 at{(left ? 0.f : 100.f) + u(rng), u(rng), u(rng)};
            all.push_back({at, {0, 1, 0}, left ? (k % 4 == 0 ? 2 * mean : 0.f) : bright, rays});
        }
        return all;
    }
};
const Vec3 left{0.5f, 0.5f, 0.5f}, right{100.5f, 0.5f, 0.5f}, up{0, 1, 0};

float value_at(const AdjointField& field, const Vec3& at, const Vec3& normal = up) {
    return adjoint_value<float>(field.tables(side, side), at, normal);
}

TEST(AdjointField, HoldsTheMeanOfTheLightBehind) {
    const Rooms rooms;
    const AdjointField field(Roulette::Rule::adjoint, rooms.trials(), {}, checkered(8));
    // Four trials of the rest of the scene are mixed with 10,000.
    EXPECT_NEAR(value_at(field, left), rooms.mean, 0.01f * rooms.mean);
    EXPECT_NEAR(value_at(field, right), rooms.bright, 0.01f * rooms.bright);
    // No trial on the other side of the surface: the mean of the cell over all sides.
    EXPECT_NEAR(value_at(field, left, {0, -1, 0}), rooms.mean, 0.01f * rooms.mean);
}

TEST(AdjointField, WeighsVarianceByWork) {
    const Rooms rooms;
    constexpr float rays_per_sample = 8;
    const AdjointField field(Roulette::Rule::efficiency, rooms.trials(), {}, checkered(rays_per_sample));
    EXPECT_NEAR(field.rays_per_sample(), rays_per_sample, 1e-6);
    // Two samples of 0 and twice the level have the variance 2 level^2; a level is a mean without its brightest sample: of 18, 12 or 8.
    EXPECT_GT(field.relative_variance(), 2);
    EXPECT_LT(field.relative_variance(), 2.6);
    const double scale = std::sqrt(rays_per_sample / field.relative_variance() / double(rooms.rays));
    EXPECT_NEAR(double(value_at(field, left)), std::sqrt(2.0) * double(rooms.mean) * scale, 0.01 * double(value_at(field, left)));
    EXPECT_NEAR(double(value_at(field, right)), double(rooms.bright) * scale, 0.01 * double(value_at(field, right)));
}

// Copies remove variance only: paths that always find the same light are not split.
TEST(AdjointField, CountsCopiesByTheVarianceOfTheLight) {
    const Rooms rooms;
    const std::vector<ContinuationTrial> trials = rooms.trials();
    const AdjointField field(Roulette::Rule::splitting, trials, trials, checkered(8));
    const AdjointTables tables = field.tables(side, side);
    ASSERT_TRUE(tables.splits);
    const double scale = std::sqrt(8 / field.relative_variance());
    constexpr double work = 0.5 + 0.3 + (1 + 0.3) * 5; // a vertex without its ray, then rays with shadow rays
    const double copies = double(adjoint_split<float>(tables, left, up));
    EXPECT_NEAR(copies, double(rooms.mean) / std::sqrt(work) * scale, 0.01 * copies);
    EXPECT_LT(double(adjoint_split<float>(tables, right, up)), 0.05 * copies);
    // Roulette is that of the efficiency rule, which does not split.
    const AdjointField efficiency(Roulette::Rule::efficiency, trials, trials, checkered(8));
    EXPECT_EQ(value_at(field, left), value_at(efficiency, left));
    EXPECT_FALSE(efficiency.tables(side, side).splits);
}

TEST(AdjointField, ComparesWithTheLuminanceOfThePixel) {
    AdjointImage image{side, side, 1, {}, side * side};
    for (int k = 0; k < side * side; ++k) image.luminance.push_back(k / side < side / 2 ? 1.f : k % side < side / 2 ? 8.f : 0.f);
    const AdjointField field(Roulette::Rule::adjoint, Rooms().trials(), {}, image);
    const AdjointTables tables = field.tables(4 * side, 2 * side);
    EXPECT_EQ(pixel_importance<float>(tables, 0.f, 0.f), 1);
    EXPECT_EQ(pixel_importance<float>(tables, float(4 * side - 1), 0.f), 1);
    EXPECT_EQ(pixel_importance<float>(tables, 0.f, float(2 * side - 1)), 1.f / 8);
    // A black pixel is worth as much as one of a fiftieth of the mean, which is 2.5 but for the brightest samples at edges.
    EXPECT_NEAR(pixel_importance<float>(tables, float(4 * side - 1), float(2 * side - 1)), 50 / 2.5f, 1);
}

TEST(AdjointField, LearnsNothingWithoutLight) {
    EXPECT_TRUE(AdjointField(Roulette::Rule::adjoint, {}, {}, checkered(8)).empty());
    Rooms dark;
    dark.mean = dark.bright = 0;
    EXPECT_TRUE(AdjointField(Roulette::Rule::adjoint, dark.trials(), {}, checkered(8)).empty());
    AdjointImage black = checkered(8);
    for (float& v : black.luminance) v = 0;
    EXPECT_TRUE(AdjointField(Roulette::Rule::efficiency, Rooms().trials(), {}, black).empty());
}

TEST(AdjointField, IgnoresWhatIsNotFinite) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    std::vector<ContinuationTrial> trials = Rooms().trials();
    AdjointImage image = checkered(8);
    const AdjointField sound(Roulette::Rule::adjoint, trials, {}, image);
    trials.push_back({left, up, nan, 1});
    trials.push_back({left, up, inf, 1});
    trials.push_back({{nan, 0, 0}, up, 1, 1});
    trials.push_back({{0, inf, 0}, up, 1, 1});
    EXPECT_EQ(AdjointField(Roulette::Rule::adjoint, trials, {}, image), sound);
    image.luminance[20] = nan;
    image.luminance[40] = inf;
    const AdjointField learned(Roulette::Rule::efficiency, trials, {}, image);
    EXPECT_TRUE(std::isfinite(learned.relative_variance()));
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) EXPECT_TRUE(std::isfinite(pixel_importance<float>(learned.tables(side, side), float(x), float(y))));
}

TEST(AdjointField, StaysFiniteForExtremeLight) {
    for (const float unit : {1e-37f, 1e-20f, 1e20f, 1e36f}) {
        std::vector<ContinuationTrial> trials = Rooms().trials();
        for (ContinuationTrial& t : trials) t.radiance *= unit;
        AdjointImage image = checkered(8);
        for (float& v : image.luminance) v *= unit;
        for (const Roulette::Rule rule : {Roulette::Rule::adjoint, Roulette::Rule::efficiency}) {
            const AdjointTables tables = AdjointField(rule, trials, {}, image).tables(side, side);
            if (tables.empty()) continue; // nothing is learned, which is sound, too
            for (const float throughput : {0.f, 1e-30f, 1.f, 1e30f}) {
                const float q = throughput * pixel_importance<float>(tables, 3.f, 5.f) * adjoint_value<float>(tables, left, up);
                EXPECT_FALSE(std::isnan(q)) << unit << " " << throughput;
            }
        }
    }
}

// Survival probabilities have no unit.
TEST(AdjointField, DoesNotDependOnTheUnitsOfLightAndLength) {
    const AdjointField field(Roulette::Rule::efficiency, Rooms().trials(), {}, checkered(8));
    for (const float unit : {0x1p-20f, 0x1p20f}) {
        std::vector<ContinuationTrial> trials = Rooms().trials();
        for (ContinuationTrial& t : trials) t = {t.position * unit, t.normal, t.radiance * unit, t.rays};
        AdjointImage image = checkered(8);
        for (float& v : image.luminance) v *= unit;
        const AdjointField scaled(Roulette::Rule::efficiency, trials, {}, image);
        const auto survival = [&](const AdjointField& f, float metres) {
            return value_at(f, left * metres) * pixel_importance<float>(f.tables(side, side), 3.f, 5.f);
        };
        EXPECT_NEAR(survival(scaled, unit) / survival(field, 1), 1, 1e-5f) << unit;
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
