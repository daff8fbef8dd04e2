// The field of path guiding: from synthetic trials, where it sends samples, and what it does not depend on.
#include "render/lights/guiding_field.h"

#include "tests/support/random_numbers.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

const Vec3 source = normalize(Vec3{1, 2, 0.5f});
constexpr int64_t emitted = 100'000;

struct Trials {
    std::vector<GuidingTrial> photons, paths;
};

// Photons on a floor of 4 x 4 m: on the left half those of a caustic from around `source`, on the right half few from anywhere. Paths
// find light of `irradiance` everywhere.
Trials trials(float scale = 1, float brightness = 1, float irradiance = 0.01f) {
    RandomNumbers random(9);
    Trials all;
    for (int i = 0; i < 40'000; ++i) {
        const Vec3 position{random(-2, 2), 0, random(-2, 2)};
        Vec3 d = normalize(source + random.direction() * 0.1f);
        if (position.x > 0) d = random.direction();
        d.y = std::abs(d.y);
        all.photons.push_back({position * scale, {0, 1, 0}, d, brightness * scale * scale * (position.x < 0 ? 1 : 1e-4f)});
        all.paths.push_back({position * scale, {0, 1, 0}, random.direction(), brightness * irradiance * random(0, 2)});
    }
    return all;
}

GuidingField learned(const Trials& t, unsigned threads = 1, std::span<const CasterSphere> casters = {}) {
    return GuidingField::learn(t.photons, emitted, t.paths, {casters.data(), int32_t(casters.size())}, Workers(threads), {}).value();
}

int32_t cell_at(const GuidingTables& t, const Vec3& position, const Vec3& normal = {0, 1, 0}) {
    return guiding_cell<float>(t.grid, position, normal);
}

TEST(GuidingField, SendsSamplesTowardsTheLight) {
    const GuidingField field = learned(trials());
    const GuidingTables t = field.tables();
    ASSERT_TRUE(t.roots);
    const int32_t root = t.roots[cell_at(t, {-1, 0, 0.3f})];
    ASSERT_GE(root, 0);
    EXPECT_EQ(t.roots[cell_at(t, {-1, 0, 0.3f}, {0, -1, 0})], -1) << "nothing arrives from below";
    RandomNumbers random(2);
    int towards = 0;
    constexpr int samples = 4000;
    for (int i = 0; i < samples; ++i) towards += dot(sample_learned_direction<float>(t, root, random(), random(), true), source) > 0.95f;
    EXPECT_GT(towards, samples * 0.8);
}

// Of learned directions; 0 where nothing has been learned.
float share_at(const GuidingTables& t, int32_t cell) { return t.roots[cell] < 0 ? 0 : t.guided[t.roots[cell]]; }

// The shares of learned directions at points of the left half, which has the caustic.
std::vector<float> shares_of(const GuidingField& field) {
    const GuidingTables t = field.tables();
    std::vector<float> shares;
    for (float x = -1.9f; x < -0.2f; x += 0.1f)
        for (float z = -1.9f; z < 1.9f; z += 0.1f) {
            const int32_t cell = cell_at(t, {x, 0, z});
            shares.push_back(share_at(t, cell));
        }
    return shares;
}

TEST(GuidingField, IsWeakenedUntilNothingIsLeft) {
    const GuidingField field = learned(trials());
    GuidingField weaker = field;
    weaker.weaken(0.25);
    const std::vector<float> before = shares_of(field), after = shares_of(weaker);
    for (size_t i = 0; i < before.size(); ++i) EXPECT_EQ(after[i], before[i] * 0.25f);
    EXPECT_FALSE(weaker.empty());
    weaker.weaken(0.01);
    EXPECT_TRUE(weaker.empty());
    EXPECT_TRUE(GuidingField().empty());
}

TEST(GuidingField, ForgetsTheCellsOfABox) {
    const GuidingField field = learned(trials());
    GuidingField rest = field;
    rest.forget({-1.5f, -0.1f, -1.2f}, {-0.5f, 0.4f, 0.3f});
    const GuidingTables t = field.tables(), after = rest.tables();
    const float cell = 1 / t.grid.cells_per_metre;
    int forgotten = 0, kept = 0;
    for (float x = -1.9f; x < -0.2f; x += 0.05f)
        for (float z = -1.9f; z < 1.9f; z += 0.05f) {
            const bool inside = x > -1.5f && x < -0.5f && z > -1.2f && z < 0.3f;
            const bool outside = x < -1.5f - cell || x > -0.5f + cell || z < -1.2f - cell || z > 0.3f + cell;
            const int32_t at = cell_at(t, {x, 0, z});
            forgotten += inside && t.roots[at] >= 0;
            kept += outside && t.roots[at] >= 0;
            EXPECT_TRUE(!inside || after.roots[at] == -1) << x << " " << z;
            EXPECT_TRUE(!outside || after.roots[at] == t.roots[at]) << x << " " << z;
        }
    EXPECT_GT(forgotten, 100);
    EXPECT_GT(kept, 100);
    rest.forget({-9, -9, -9}, {9, 9, 9});
    EXPECT_TRUE(rest.empty());
}

// As many photons as the pilot traces at most, in a cube: the largest number of cells.
TEST(GuidingField, TakesAtMost32MiB) {
    RandomNumbers random(4);
    Trials all;
    for (int i = 0; i < 262'144; ++i) {
        const Vec3 d = random.direction();
        all.photons.push_back({{random(-2, 2), random(-2, 2), random(-2, 2)}, {0, i % 2 ? 1.f : -1.f, 0}, d, 1});
    }
    const GuidingField field = learned(all, 2);
    EXPECT_FALSE(field.empty());
    EXPECT_LT(field.memory_bytes(), int64_t(32) << 20);
}

TEST(GuidingField, ReleasedFieldsKeepTheirFiguresAlone) {
    GuidingField field = learned(trials());
    const auto figures = field.figures();
    ASSERT_TRUE(figures);
    field.release();
    EXPECT_EQ(field.memory_bytes(), 0);
    EXPECT_TRUE(field.empty());
    EXPECT_FALSE(field.tables().roots);
    EXPECT_EQ(field.figures(), figures);
}

TEST(GuidingField, ProbabilitiesFollowTheFlux) {
    RandomNumbers random(8);
    Trials all;
    for (int i = 0; i < 40'000; ++i) {
        const bool right = i % 2 == 0;
        const Vec3 d = normalize(Vec3{right ? 1.f : -1.f, 1, 0} + random.direction() * 0.2f);
        all.photons.push_back({{random(-2, 2), 0, random(-2, 2)}, {0, 1, 0}, d, right ? 3.f : 1.f});
    }
    const GuidingField field = learned(all);
    const GuidingTables t = field.tables();
    ASSERT_TRUE(t.roots);
    int right = 0;
    constexpr int samples = 40'000;
    for (int i = 0; i < samples; ++i) {
        const int32_t root = t.roots[cell_at(t, {random(-1.9f, 1.9f), 0, random(-1.9f, 1.9f)})];
        right += sample_learned_direction<float>(t, root, random(), random(), true).x > 0;
    }
    EXPECT_NEAR(double(right) / samples, 0.75, 0.02); // 0.02 of each node is spread evenly
}

// Flux of 20,000 photons of 1 among 100,000 on 8 m2 is an irradiance of 0.025.
TEST(GuidingField, ShareFollowsTheIrradiance) {
    for (const float irradiance : {0.2f, 1.f}) {
        const GuidingField field = learned(trials(1, 1, irradiance));
        const GuidingTables t = field.tables();
        double sum = 0;
        int cells = 0;
        for (float x = -1.9f; x < -0.2f; x += 0.1f)
            for (float z = -1.9f; z < 1.9f; z += 0.1f, ++cells) sum += double(share_at(t, cell_at(t, {x, 0, z})));
        // The root of the second moment of values that are uniform in [0, 2 E), without the largest of them, is about 1.13 E.
        const double weighted = 4 * 0.025, expected = weighted / (weighted + 1.13 * double(irradiance));
        EXPECT_NEAR(sum / cells, expected, 0.15 * expected) << irradiance;
        EXPECT_LT(share_at(t, cell_at(t, {1, 0, 0})), 0.04f) << "no caustic there";
    }
    const GuidingField dark = learned(trials(1, 1, 0));
    EXPECT_EQ(share_at(dark.tables(), cell_at(dark.tables(), {-1, 0, 0})), max_guided_share);
}

// Cosine sampling finds the source, a cone of 0.01 sr or so, seldom; where the other light is strong, this does not matter.
TEST(GuidingField, ExpectsWhatItGains) {
    const auto gain = [](float irradiance, std::span<const CasterSphere> casters = {}) {
        const std::optional<PilotFigures> figures = learned(trials(1, 1, irradiance), 1, casters).figures();
        EXPECT_TRUE(figures);
        return figures ? figures->mse : 0;
    };
    EXPECT_LT(gain(0.01f), 0.1);
    EXPECT_GT(gain(10), 0.9);
    EXPECT_LE(gain(10), 1.2);
    // A caster that is guided without a field leaves less to gain.
    const CasterSphere ball{source * 20.f, 4};
    EXPECT_GT(gain(0.01f, {&ball, 1}), 2 * gain(0.01f));
    EXPECT_FALSE(learned({trials().photons, {}}).figures()) << "no path meets a region";
}

TEST(GuidingField, IsTheSameForAnyNumberOfThreads) {
    const Trials all = trials();
    EXPECT_EQ(learned(all, 1), learned(all, 3));
}

TEST(GuidingField, ScalesExactlyWithPowersOfTwo) {
    const GuidingField plain = learned(trials());
    for (const auto& [scale, brightness] : {std::pair{0x1p-20f, 1.f}, {0x1p20f, 1.f}, {1.f, 2.f}, {1.f, 0x1p-31f}}) {
        const GuidingField field = learned(trials(scale, brightness));
        EXPECT_EQ(field.figures(), plain.figures());
        RandomNumbers random(6);
        for (int i = 0; i < 2000; ++i) {
            const Vec3 at{random(-2, 2), 0, random(-2, 2)};
            const int32_t cell = cell_at(plain.tables(), at), root = plain.tables().roots[cell];
            ASSERT_EQ(cell_at(field.tables(), at * scale), cell);
            ASSERT_EQ(field.tables().roots[cell], root);
            EXPECT_EQ(share_at(field.tables(), cell), share_at(plain.tables(), cell));
            const float u = random(), v = random();
            if (root < 0) continue;
            EXPECT_EQ(sample_learned_direction<float>(field.tables(), root, u, v, true),
                      sample_learned_direction<float>(plain.tables(), root, u, v, true));
        }
    }
}

TEST(GuidingField, IgnoresTrialsThatAreNotFinite) {
    const Trials all = trials();
    Trials more = all;
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const Vec3 up{0, 1, 0};
    for (const GuidingTrial& t : {GuidingTrial{{nan, 0, 0}, up, up, 1},
                                  {{0, 0, 0}, {0, 0, 0}, up, 1},
                                  {{0, 0, 0}, {nan, 0, 0}, up, 1},
                                  {{0, 0, 0}, up, {inf, 0, 0}, 1},
                                  {{0, 0, 0}, up, up, nan},
                                  {{0, 0, 0}, up, up, inf},
                                  {{0, 0, 0}, up, up, -1}})
        for (int i = 0; i < 100; ++i) {
            more.photons.push_back(t);
            more.paths.push_back(t);
        }
    EXPECT_EQ(learned(more), learned(all));
}

// An edit does not wait for a field that it makes useless.
TEST(GuidingField, StopsWhenItIsNotWanted) {
    const Trials t = trials();
    EXPECT_FALSE(GuidingField::learn(t.photons, emitted, t.paths, {}, Workers(2), [] { return false; }));
    EXPECT_EQ(GuidingField::learn(t.photons, emitted, t.paths, {}, Workers(2), [] { return true; }), learned(t));
}

TEST(GuidingField, WithoutPhotonsLearnsNothing) {
    EXPECT_FALSE(learned({{}, trials().paths}).tables().roots);
    EXPECT_FALSE(learned({}).figures());
    EXPECT_FALSE(learned(trials(0)).tables().roots) << "all of them in one place";
    // Little and much flux neither overflow nor divide by 0.
    for (const float brightness : {0.f, 1e-30f, 1e36f}) {
        const GuidingField field = learned(trials(1, brightness));
        if (!field.tables().roots) continue;
        EXPECT_GT(brightness, 0);
        const int32_t cell = cell_at(field.tables(), {-1, 0, 0.3f});
        EXPECT_GE(share_at(field.tables(), cell), 0);
        EXPECT_LE(share_at(field.tables(), cell), max_guided_share);
        const Vec3 d = sample_learned_direction<float>(field.tables(), field.tables().roots[cell], 0.3f, 0.7f, true);
        EXPECT_NEAR(dot(d, d), 1, 1e-5);
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
