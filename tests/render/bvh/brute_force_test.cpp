// The brute-force tracer of small scenes: finds what the BVH finds, lets no ray through between triangles that touch, and is used only
// where it suits the scene.
#include "render/bvh/brute_force.h"
#include "render/compile/scene_tables.h"
#include "tests/render/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

struct Random {
    std::mt19937 bits{7};
    float operator()(float low = 0, float high = 1) { return low + (high - low) * float(bits() >> 8) * 0x1p-24f; }
    Vec3 point(float reach) { return {(*this)(-reach, reach), (*this)(-reach, reach), (*this)(-reach, reach)}; }
};

struct Mesh {
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;
    uint32_t mask = seen_by_all;

    // A box of twelve triangles, scaled by `half`, turned by `turn` radians about two axes, around `center`.
    void add_box(const Vec3& center, const Vec3& half, float turn) {
        const auto first = uint32_t(positions.size());
        for (int i = 0; i < 8; ++i) {
            const Vec3 p{i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z};
            const float c = std::cos(turn), s = std::sin(turn);
            const Vec3 q{c * p.x - s * p.z, p.y, s * p.x + c * p.z};
            positions.push_back(Vec3{c * q.x - s * q.y, s * q.x + c * q.y, q.z} + center);
        }
        for (const auto& quad : {std::array{0u, 1u, 3u, 2u}, std::array{4u, 6u, 7u, 5u}, std::array{0u, 4u, 5u, 1u},
                                 std::array{2u, 3u, 7u, 6u}, std::array{0u, 2u, 6u, 4u}, std::array{1u, 5u, 7u, 3u}})
            for (const size_t k : {0, 1, 2, 0, 2, 3}) indices.push_back(first + quad[k]);
    }
};

struct Built {
    std::vector<Mesh> meshes;
    SceneTables tables{};
    Accel accel;
    explicit Built(std::vector<Mesh> m) : meshes(std::move(m)) { accel.commit(scene(), &tables, Workers(1)); }
    AccelScene scene() const {
        AccelScene s;
        for (const Mesh& m : meshes)
            s.flat.push_back(
                {0, nullptr, m.positions.data(), m.positions.size(), m.indices.data(), m.indices.size() / 3, 0, false, m.mask});
        return s;
    }
};

// A room that holds four boxes and a tetrahedron: 60 and 4 triangles, quadrilaterals and single ones.
std::vector<Mesh> room(Random& random) {
    std::vector<Mesh> meshes(6);
    meshes[0].add_box({0, 0, 0}, {2, 1.5f, 2.5f}, 0);
    for (size_t i = 1; i < 5; ++i) meshes[i].add_box(random.point(1.2f), random.point(0.2f) + Vec3{0.3f, 0.3f, 0.3f}, random(0, 3));
    for (int i = 0; i < 4; ++i) meshes[5].positions.push_back(random.point(1));
    meshes[5].indices = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};
    return meshes;
}

struct Rays {
    std::array<std::vector<float>, 7> columns; // origin, direction, largest distance
    std::vector<uint32_t> masks;
    void add(const Vec3& o, const Vec3& d, float far) {
        const float row[]{o.x, o.y, o.z, d.x, d.y, d.z, far};
        for (size_t k = 0; k < columns.size(); ++k) columns[k].push_back(row[k]);
    }
    int count() const { return int(columns[0].size()); }
    void pad() {
        while (count() % 16) add({0, 0, 0}, {0, 0, 1}, 1);
    }
    RayArrays arrays(bool limited) const {
        const auto c = [&](size_t k) { return columns[k].data(); };
        return {
            c(0), c(1), c(2), c(3), c(4), c(5), limited ? c(6) : nullptr, nullptr, other_ray_mask, masks.empty() ? nullptr : masks.data()};
    }
};
struct Hits {
    std::vector<float> t, u, v;
    std::vector<int32_t> geometry, instance, triangle;
    explicit Hits(int n) : t(size_t(n)), u(t), v(t), geometry(size_t(n)), instance(geometry), triangle(geometry) {}
    HitArrays arrays() { return {t.data(), u.data(), v.data(), geometry.data(), instance.data(), triangle.data()}; }
    float least_weight(size_t i) const { return std::min({u[i], v[i], 1 - u[i] - v[i]}); }
};

Rays random_rays(Random& random, int count) {
    Rays rays;
    for (int i = 0; i < count; ++i) rays.add(random.point(2.2f), random.point(1), random(0.1f, 3));
    return rays;
}

TEST(BruteForce, HitsWhatTheBvhHits) {
    Random random;
    for (int round = 0; round < 20; ++round) {
        const Built built(room(random));
        ASSERT_NE(built.accel.small_scene(), nullptr);
        const Rays rays = random_rays(random, 16 * 1024);
        Hits all(rays.count()), bvh(rays.count());
        intersect_all<Wide>(*built.accel.small_scene(), rays.arrays(false), rays.count(), all.arrays());
        built.accel.intersect(rays.arrays(false), rays.count(), false, bvh.arrays());
        int differ = 0;
        for (size_t i = 0; i < size_t(rays.count()); ++i) {
            if (all.geometry[i] != bvh.geometry[i] || (all.geometry[i] >= 0 && all.triangle[i] != bvh.triangle[i])) {
                // Only at edges, which both tracers round.
                ++differ;
                const float nearest =
                    std::min(all.geometry[i] >= 0 ? all.least_weight(i) : 1, bvh.geometry[i] >= 0 ? bvh.least_weight(i) : 1);
                EXPECT_LT(nearest, 1e-4f) << "ray " << i;
                continue;
            }
            EXPECT_EQ(all.instance[i], -1);
            if (all.geometry[i] < 0) continue;
            EXPECT_NEAR(all.t[i], bvh.t[i], 2e-4f * std::max(1.f, bvh.t[i])) << i;
            EXPECT_NEAR(all.u[i], bvh.u[i], 2e-4f) << i;
            EXPECT_NEAR(all.v[i], bvh.v[i], 2e-4f) << i;
        }
        EXPECT_LE(differ, 8);
    }
}

TEST(BruteForce, IsBlockedByWhatIsHitWithinTheDistance) {
    Random random;
    const Built built(room(random));
    const SmallScene& scene = *built.accel.small_scene();
    const Rays rays = random_rays(random, 16 * 1024);
    Hits closest(rays.count());
    intersect_all<Wide>(scene, rays.arrays(false), rays.count(), closest.arrays());
    std::vector<uint8_t> blocked(size_t(rays.count()) + 16);
    occluded_by_any<Wide>(scene, rays.arrays(true), rays.count(), blocked.data());
    int count = 0;
    for (size_t i = 0; i < size_t(rays.count()); ++i) {
        EXPECT_EQ(bool(blocked[i]), closest.geometry[i] >= 0 && closest.t[i] < rays.columns[6][i]) << i;
        count += blocked[i];
    }
    EXPECT_GT(count, 4000);
    EXPECT_LT(count, 15000);
}

TEST(BruteForce, HasTheSameHitsInEveryLaneWidth) {
    Random random;
    const Built built(room(random));
    const SmallScene& scene = *built.accel.small_scene();
    const Rays rays = random_rays(random, 4096);
    Hits wide(rays.count()), one(rays.count());
    intersect_all<Wide>(scene, rays.arrays(true), rays.count(), wide.arrays());
    intersect_all<float>(scene, rays.arrays(true), rays.count(), one.arrays());
    EXPECT_EQ(wide.t, one.t);
    EXPECT_EQ(wide.triangle, one.triangle);
    EXPECT_EQ(wide.geometry, one.geometry);
    for (size_t i = 0; i < size_t(rays.count()); ++i) {
        if (one.geometry[i] < 0) continue;
        ASSERT_EQ(wide.u[i], one.u[i]);
        ASSERT_EQ(wide.v[i], one.v[i]);
    }
}

// From inside a room that is turned, so that its planes are not axes, towards points on its edges and to its corners.
TEST(BruteForce, LetsNoRayThroughAtEdgesAndCorners) {
    Random random;
    for (const float scale : {1e-6f, 1.f, 1e6f}) {
        const Vec3 center = Vec3{0.1f, 0.2f, 0.3f} * scale;
        Mesh box;
        box.add_box(center, Vec3{1, 0.7f, 1.3f} * scale, 0.6f);
        Mesh around;
        around.add_box({0, 0, 0}, Vec3{3, 3, 3} * scale, 0);
        const Built built({box, around});
        ASSERT_NE(built.accel.small_scene(), nullptr);
        Rays rays;
        for (int i = 0; i < 200'000; ++i) {
            const uint32_t* corners = &box.indices[3 * (random.bits() % 12)];
            const Vec3 a = box.positions[corners[0]], b = box.positions[corners[1 + random.bits() % 2]];
            const Vec3 at = i % 10 == 0 ? a : a + (b - a) * random(), from = center + random.point(0.4f * scale);
            rays.add(from, at - from, 1);
        }
        rays.pad();
        Hits hits(rays.count());
        intersect_all<Wide>(*built.accel.small_scene(), rays.arrays(false), rays.count(), hits.arrays());
        EXPECT_EQ(std::ranges::count(hits.geometry, 0), rays.count()) << "scale " << scale;
    }
}

TEST(BruteForce, HidesFacesFromRaysOfOtherMasks) {
    Random random;
    std::vector<Mesh> meshes = room(random);
    meshes[0].mask = camera_ray_mask;
    const Built built(meshes);
    ASSERT_NE(built.accel.small_scene(), nullptr);
    Rays rays = random_rays(random, 4096);
    for (int i = 0; i < rays.count(); ++i) rays.masks.push_back(i % 2 ? camera_ray_mask : other_ray_mask);
    Hits hits(rays.count());
    intersect_all<Wide>(*built.accel.small_scene(), rays.arrays(false), rays.count(), hits.arrays());
    int seen = 0;
    for (size_t i = 0; i < size_t(rays.count()); ++i) {
        if (i % 2 == 0) { EXPECT_NE(hits.geometry[i], 0); }
        seen += hits.geometry[i] == 0;
    }
    EXPECT_GT(seen, 100);
}

TEST(BruteForce, MissesOrHitsNothingWithRaysThatAreNotFinite) {
    Random random;
    const Built built(room(random));
    Rays rays;
    for (const float bad : {NAN, INFINITY, -INFINITY}) {
        rays.add({bad, 0, 0}, {0, 0, 1}, 1);
        rays.add({0, 0, 0}, {0, bad, 1}, 1);
    }
    rays.add({0, 0, 0}, {0, 0, 0}, 1);
    const int bad_rays = rays.count();
    rays.pad();
    Hits hits(rays.count());
    intersect_all<Wide>(*built.accel.small_scene(), rays.arrays(false), rays.count(), hits.arrays());
    for (int i = 0; i < bad_rays; ++i) EXPECT_EQ(hits.geometry[size_t(i)], -1) << i;
}

TEST(SmallScenes, AreClosedSimilarInScaleAndSmall) {
    Random random;
    const auto fits = [](const AccelScene& scene) { return make_small_scene(scene).has_value(); };
    const Built good(room(random));
    EXPECT_TRUE(fits(good.scene()));
    EXPECT_EQ(good.accel.small_scene()->triangles.size(), 2 * good.accel.small_scene()->faces.size());
    EXPECT_LT(good.accel.small_scene()->faces.size(), 64u);
    const Built walls({good.meshes[0]});
    EXPECT_EQ(walls.accel.small_scene()->faces.size(), 6u); // each two triangles
    EXPECT_EQ(walls.accel.small_scene()->positions.size(), 8u);

    std::vector<Mesh> large = good.meshes;
    large[0].add_box({0, 0, 0}, {0.1f, 0.1f, 0.1f}, 0);
    EXPECT_FALSE(fits(Built(large).scene()));
    large.back().mask = 0; // is not traced
    large[4].mask = 0;
    EXPECT_TRUE(fits(Built(large).scene()));

    std::vector<Mesh> open(good.meshes.begin() + 1, good.meshes.end());
    EXPECT_FALSE(fits(Built(open).scene()));

    std::vector<Mesh> tiny = good.meshes;
    for (Vec3& p : tiny[5].positions) p = p * 1e-5f;
    EXPECT_FALSE(fits(Built(tiny).scene()));

    std::vector<Mesh> broken = good.meshes;
    broken[5].positions[0].x = NAN;
    EXPECT_FALSE(fits(Built(broken).scene()));

    AccelScene with_alpha = good.scene();
    with_alpha.flat[3].alpha = true;
    EXPECT_FALSE(fits(with_alpha));
    AccelScene with_sphere = good.scene();
    with_sphere.spheres.push_back({{0, 0, 0}, 0.1f});
    EXPECT_FALSE(fits(with_sphere));
    EXPECT_FALSE(fits({}));

    std::vector<Mesh> flat_triangle = good.meshes;
    flat_triangle[5].positions[1] = flat_triangle[5].positions[0]; // two triangles have no area
    EXPECT_TRUE(fits(Built(flat_triangle).scene()));
}

} // namespace
} // namespace blush::test::TEST_FILE
