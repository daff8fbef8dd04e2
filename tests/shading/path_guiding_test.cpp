// Path guiding: directions have their stated density, in the learned quadtree alone, in the mixture with the cosine, and in all lanes.
#include "shading/path_guiding.h"

#include "tests/support/random_numbers.h"
#include "tests/support/statistics.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using namespace statistics;

constexpr double sphere_area = 4 * std::numbers::pi;

constexpr float guided_share = 0.375f;

// A quadtree of random shares, some of them 0, down to the last level around one direction.
struct Quadtree {
    std::vector<int32_t> nodes, roots;
    std::vector<float> shares, guided;
    RandomNumbers random{11};

    explicit Quadtree(const ReceiverGrid& grid = {}) : roots(size_t(grid.count()) * guiding_sides, -1), grid_(grid) {
        add(0);
        guided.assign(nodes.size() / 4, guided_share);
    }
    GuidingTables tables() const { return {roots.data(), guided.data(), shares.data(), nodes.data(), grid_}; }

private:
    ReceiverGrid grid_;
    int32_t add(int level) {
        const size_t node = nodes.size() / 4;
        nodes.resize(nodes.size() + 4, -1);
        shares.resize(shares.size() + 4);
        std::array<float, 4> share{};
        float sum = 0;
        for (float& s : share) sum += s = random(0, 1) < 0.2f ? 0 : random(0, 1);
        share[size_t(level) % 4] += 1;
        for (size_t k = 0; k < 4; ++k) shares[4 * node + k] = share[k] / (sum + 1);
        for (size_t k = 0; k < 4; ++k)
            if (level + 1 < guiding_levels && (k == size_t(level) % 4 || (level < 3 && random(0, 1) < 0.5f)))
                nodes[4 * node + k] = add(level + 1);
        return int32_t(node);
    }
};

size_t bin_of(const Vec3& d, int side) {
    const Vec2T<float> at = guiding_point<float>(d);
    return size_t(int(at.y * float(side)) * side + int(at.x * float(side)));
}

TEST(PathGuiding, DirectionsFollowTheirDensity) {
    const Quadtree tree;
    RandomNumbers random(3);
    constexpr int side = 64, samples = 400'000, fine = 1 << guiding_levels;
    std::vector<int64_t> counts(side * side);
    std::vector<double> expected(side * side);
    for (int i = 0; i < samples; ++i) {
        const Vec3 d = sample_learned_direction<float>(tree.tables(), 0, random(), random(), true);
        ASSERT_NEAR(dot(d, d), 1, 1e-5);
        ASSERT_GT(learned_density<float>(tree.tables(), 0, d, true), 0);
        ++counts[bin_of(d, side)];
    }
    // The density is constant on the squares of the last level.
    double total = 0;
    for (int y = 0; y < fine; ++y)
        for (int x = 0; x < fine; ++x) {
            const float height = 2 * (float(y) + 0.5f) / fine - 1, radius = std::sqrt(1 - height * height);
            const SinCos<float> a = sincos_turns((float(x) + 0.5f) / fine - 0.5f);
            const Vec3 d{radius * a.sin, height, radius * a.cos};
            const double share = double(learned_density<float>(tree.tables(), 0, d, true)) / (double(fine) * fine);
            total += share;
            expected[bin_of(d, side)] += share * samples;
        }
    EXPECT_NEAR(total, 1, 1e-4);
    EXPECT_TRUE(chi_squared_test(counts, expected, significance));
}

// The mixture integrates the cosine lobe and parts of it, beside a caster that the learned region replaces.
TEST(PathGuiding, MixtureIsUnbiasedOverTheHemisphere) {
    const ReceiverGrid grid{{2, 1, 1}, {-1, -1, -1}, 1};
    Quadtree tree(grid);
    const Vec3 up{0, 0, 1};
    const CasterSphere ball{{0.5f, 0, 2}, 0.5f};
    tree.roots[size_t(guiding_cell<float>(grid, {-0.5f, 0, 0}, up))] = 0;
    const GuideTables tables{{&ball, 1}, tree.tables()};
    RandomNumbers random(7);
    for (const float x : {-0.5f, 0.5f}) {
        const DirectionGuide<float> guide = direction_guide_at<float>(tables, {x, 0, 0}, up, true);
        EXPECT_EQ(guide.learned, x < 0);
        EXPECT_EQ(guide.share, x < 0 ? guided_share : guide.casters.share);
        EXPECT_GT(guide.share, 0);
        Moments all, right, steep;
        for (int i = 0; i < 400'000; ++i) {
            const float choice = random(), u = random(), v = random();
            const Vec3 w = choice < guide.share ? sample_guided_direction<float>(tables, guide, choice / guide.share, u, v)
                                                : sample_cosine_hemisphere(u, v);
            const float cosine = cosine_hemisphere_pdf(w.z);
            const double value = cosine > 0 ? double(cosine) / double(guided_pdf<float>(tables, guide, w, cosine)) : 0;
            ASSERT_LE(value, 1 / (1 - double(max_guided_share)) + 1e-5);
            all.add(value);
            right.add(w.x > 0 ? value : 0);
            steep.add(w.z > 0.8f ? value : 0);
        }
        const double alpha = sidak(significance, 6);
        EXPECT_TRUE(z_test(all, 1, alpha)) << x;
        EXPECT_TRUE(z_test(right, 0.5, alpha)) << x;
        EXPECT_TRUE(z_test(steep, 1 - 0.64, alpha)) << x;
    }
}

TEST(PathGuiding, SidesAreThoseOfTheNormal) {
    const ReceiverGrid grid;
    std::vector<int32_t> seen;
    for (const Vec3& n : {Vec3{1, 0.2f, 0}, {-1, 0.2f, 0}, {0.3f, 1, 0}, {0, -1, 0.9f}, {0, 0.1f, 1}, {0.5f, 0.5f, -1}})
        seen.push_back(guiding_cell<float>(grid, {0, 0, 0}, n));
    EXPECT_EQ(seen, (std::vector<int32_t>{0, 1, 2, 3, 4, 5}));
    EXPECT_LT(guiding_cell<float>(grid, {NAN, 0, 0}, {NAN, NAN, NAN}), guiding_sides);
    EXPECT_GE(guiding_cell<float>(grid, {NAN, 0, 0}, {NAN, NAN, NAN}), 0);
}

TEST(PathGuiding, OnlyLambertianSurfacesAreGuided) {
    Quadtree tree;
    for (int32_t& root : tree.roots) root = 0;
    EXPECT_EQ(direction_guide_at<float>({{}, tree.tables()}, {0, 0, 0}, {0, 0, 1}, false).share, 0);
    EXPECT_EQ(direction_guide_at<float>({{}, tree.tables()}, {0, 0, 0}, {0, 0, 1}, true).share, guided_share);
    EXPECT_EQ(direction_guide_at<float>({}, {0, 0, 0}, {0, 0, 1}, true).share, 0);
}

} // namespace
} // namespace blush::test::TEST_FILE
