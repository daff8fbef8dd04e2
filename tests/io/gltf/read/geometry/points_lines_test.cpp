// Points and lines as small solids: closed, wound outwards, of the documented radius.
#include "io/gltf/read/geometry/points_lines.h"

#include "core/math.h"
#include "scene/affine.h"
#include "tests/io/gltf/builder.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace blush::test::TEST_FILE {
namespace {

// The corner of a cube and its three neighbours: a diagonal of 500, so that solids have a radius of 1.
Geometry corners() {
    Geometry g;
    const float side = 500 / std::sqrt(3.f);
    g.positions = {{0, 0, 0}, {side, 0, 0}, {0, side, 0}, {0, 0, side}};
    g.colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}};
    return g;
}

// Enclosed volume; positive if wound outwards.
double volume(const Geometry& g) {
    double sum = 0;
    for (size_t i = 0; i < g.indices.size(); i += 3) {
        const auto corner = [&](size_t k) { return to_double(g.positions[g.indices[i + k]]); };
        sum += dot(corner(0), cross(corner(1), corner(2))) / 6;
    }
    return sum;
}

// Every edge is used once in each direction.
bool is_closed(const Geometry& g) {
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (size_t i = 0; i < g.indices.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) ++edges[{g.indices[i + k], g.indices[i + (k + 1) % 3]}];
    return std::ranges::all_of(edges, [&](const auto& e) { return e.second == 1 && edges.contains({e.first.second, e.first.first}); });
}

TEST(GltfPointsLines, SolidsAreClosed) {
    const Geometry source = corners();
    const Solids ball = solids_of(source, std::array{1u}, 0), tube = solids_of(source, std::array{0u, 2u}, 1);
    for (const Solids* made : {&ball, &tube}) {
        EXPECT_EQ(made->shown, 1u);
        EXPECT_NEAR(made->radius, 1, 1e-6);
        EXPECT_TRUE(is_closed(made->geometry));
        const Geometry& g = made->geometry;
        ASSERT_EQ(g.normals.size(), g.positions.size());
        for (size_t i = 0; i < g.indices.size(); i += 3) {
            const auto p = [&](size_t k) { return to_double(g.positions[g.indices[i + k]]); };
            EXPECT_GT(dot(cross(p(1) - p(0), p(2) - p(0)), to_double(g.normals[g.indices[i]])), 0) << "faces agree with their normals";
        }
    }
    for (const Vec3& p : ball.geometry.positions) EXPECT_NEAR(length(p - source.positions[1]), 1, 1e-5);
    // A regular icosahedron within the unit sphere, and a hexagonal prism with a pyramid of height 1 at each end.
    EXPECT_NEAR(volume(ball.geometry), 2.53615, 1e-3);
    EXPECT_NEAR(volume(tube.geometry), 1.5 * std::sqrt(3) * (double(source.positions[2].y) + 2.0 / 3), 1e-2);
    EXPECT_EQ(ball.geometry.colors.front(), source.colors[1]);
    EXPECT_EQ(tube.geometry.colors.front(), source.colors[0]);
    EXPECT_EQ(tube.geometry.colors.back(), source.colors[2]);
}

TEST(GltfPointsLines, ModesAreThoseOfGltf) {
    constexpr size_t shown[] = {3, 1, 3, 2}; // points, lines, a loop, a strip
    for (int mode = 0; mode < 4; ++mode) {
        GltfBuilder b;
        b.show({{"attributes", {{"POSITION", b.triangle_positions()}}}, {"mode", mode}});
        const auto imported = import_built(b);
        ASSERT_TRUE(imported) << error_text(imported);
        const auto& parts = imported->scene.meshes.begin()->value.parts;
        ASSERT_EQ(parts.size(), 1u);
        EXPECT_EQ(parts[0].geometry->triangle_count(), shown[mode] * (mode == 0 ? 20 : 24)) << mode;
        EXPECT_TRUE(reports(imported->report, "approximated: " + std::to_string(shown[mode]) + (mode == 0 ? " points" : " lines")));
    }
}

TEST(GltfPointsLines, SkippedPointsAndLinesAreCounted) {
    Geometry g = corners();
    g.positions[3] = {std::numeric_limits<float>::quiet_NaN(), 0, 0};
    EXPECT_EQ(solids_of(g, std::vector<uint32_t>{0, 3, 1}, 0).left_out, 1u);
    EXPECT_EQ(solids_of(g, std::vector<uint32_t>{0, 1, 3, 1, 2, 2}, 1).left_out, 2u);
    const Solids many = solids_of(g, std::vector<uint32_t>(max_points_and_segments + 5, 1), 0);
    EXPECT_EQ(many.shown, max_points_and_segments);
    EXPECT_EQ(many.left_out, 5u);
    EXPECT_EQ(mark_radius({{1, 2, 3}}), 0.005f) << "a single position has no extent";

    GltfBuilder b;
    b.show({{"attributes", {{"POSITION", b.accessor<float>({1, 2, 3, 1, 2, 3}, "VEC3")}}}, {"mode", 1}});
    const auto imported = import_built(b);
    ASSERT_TRUE(imported) << error_text(imported);
    EXPECT_TRUE(imported->scene.meshes.begin()->value.parts.empty());
    EXPECT_TRUE(reports(imported->report, "ignored: 1 lines"));
}

} // namespace
} // namespace blush::test::TEST_FILE
