// Compact BVHs, which store indices instead of vertices: used if memory is short, reported, and bit-identical for rays.
#include "render/bvh/accel.h"
#include "render/bvh/compact_bvh.h"
#include "render/compile/scene_tables.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <cmath>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

// A bumpy sheet of 2 n^2 triangles over [-1, 1]^2.
GeometryPtr sheet(uint32_t n) {
    auto g = std::make_shared<Geometry>();
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i) {
            const float x = 2 * float(i) / float(n) - 1, z = 2 * float(j) / float(n) - 1;
            g->positions.push_back({x, 0.1f * std::sin(9 * x) * std::cos(7 * z), z});
        }
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i) {
            const uint32_t a = j * (n + 1) + i, c = a + n + 2;
            g->indices.insert(g->indices.end(), {a, c, a + 1, a, c - 1, c});
        }
    return g;
}

TEST(CompactBvh, IsUsedIfMemoryIsShort) {
    constexpr uint64_t gigabyte = 1'000'000'000;
    EXPECT_FALSE(needs_compact_bvh(1'000'000, 4 * gigabyte));
    EXPECT_TRUE(needs_compact_bvh(1'000'000, gigabyte / 10));
    EXPECT_FALSE(needs_compact_bvh(20'000'000, 16 * gigabyte));
    EXPECT_TRUE(needs_compact_bvh(20'000'000, 2 * gigabyte));
}

// Ray-triangle tests use the same arithmetic, so the image does not depend on the available memory.
TEST(CompactBvh, HitsTheSameTrianglesBitForBit) {
    const GeometryPtr shape = sheet(150);
    const size_t triangles = shape->triangle_count();
    const std::vector<InstanceRecord> places{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1f, 0.2f, 0.3f}}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const SceneTables tables{};
    const auto build = [&](Accel& accel, uint64_t memory_left) {
        AccelScene scene;
        scene.instances.push_back(
            {{{shape->serial, nullptr, shape->positions.data(), shape->positions.size(), shape->indices.data(), triangles}}, places});
        scene.memory_left = memory_left;
        accel.commit(scene, &tables, Workers(1));
    };
    Accel with_corners, compact;
    build(with_corners, uint64_t(1) << 40);
    build(compact, triangles);
    EXPECT_EQ(with_corners.compact_triangles(), 0u);
    EXPECT_EQ(compact.compact_triangles(), triangles);
    EXPECT_LT(compact.memory_bytes(), with_corners.memory_bytes());

    constexpr int n = 4096;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<float> rays[6];
    for (std::vector<float>& column : rays)
        for (int i = 0; i < n; ++i) column.push_back(uniform(random));
    for (float& y : rays[1]) y = 1 + y;
    const RayArrays r{rays[0].data(), rays[1].data(), rays[2].data(), rays[3].data(), rays[4].data(), rays[5].data(), nullptr, nullptr};
    struct Hits {
        std::vector<float> t = std::vector<float>(n), u = t, v = t;
        std::vector<int32_t> geometry = std::vector<int32_t>(n), instance = geometry, triangle = geometry;
        HitArrays arrays() { return {t.data(), u.data(), v.data(), geometry.data(), instance.data(), triangle.data()}; }
    } a, b;
    with_corners.intersect(r, n, false, a.arrays());
    compact.intersect(r, n, false, b.arrays());
    int met = 0;
    for (size_t i = 0; i < n; ++i) {
        ASSERT_EQ(a.geometry[i], b.geometry[i]);
        if (a.geometry[i] < 0) continue;
        ++met;
        ASSERT_EQ(a.t[i], b.t[i]);
        ASSERT_EQ(a.u[i], b.u[i]);
        ASSERT_EQ(a.v[i], b.v[i]);
        ASSERT_EQ(a.triangle[i], b.triangle[i]);
    }
    EXPECT_GT(met, n / 10);
}

TEST(CompactBvh, IsNotUsedIfMemorySuffices) {
    Scene scene;
    place(scene, sheet(520), lambert(0.5f));
    constant_world(scene, 1);
    Renderer renderer({.threads = 1, .planes = {}});
    renderer.update(scene, settings_for(8, 8, 1));
    const auto feature_report = renderer.feature_report();
    const auto line = std::ranges::find(*feature_report, "BVH stores vertices", &FeatureUse::name);
    ASSERT_NE(line, feature_report->end());
    EXPECT_TRUE(line->used) << line->why;
}

} // namespace
} // namespace blush::test::TEST_FILE
