// Tangents of small meshes against the definition of MikkTSpace.
#include "core/math.h"
#include "scene/geometry/mikktspace.h"
#include "scene/geometry/tangents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush::TEST_FILE {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

struct Corner {
    Vec3 position;
    Vec2 uv;
};

// In the plane z = 0, facing +Z.
Geometry flat(const std::vector<Corner>& corners, const std::vector<uint32_t>& indices) {
    Geometry g;
    g.uv.resize(1);
    for (const Corner& c : corners) {
        g.positions.push_back(c.position);
        g.uv[0].push_back(c.uv);
    }
    g.normals.assign(corners.size(), {0, 0, 1});
    g.indices.assign(indices.begin(), indices.end());
    return g;
}

void expect_tangent(const Vec4& t, Vec3 direction, float handedness) {
    const Vec3 d = normalize(direction);
    EXPECT_NEAR(t.x, d.x, 1e-6);
    EXPECT_NEAR(t.y, d.y, 1e-6);
    EXPECT_NEAR(t.z, d.z, 1e-6);
    EXPECT_EQ(t.w, handedness);
}

// Around the origin a triangle of 90 degrees with u along +X, and one of 45 degrees and `size` with u along (1, -0.5).
Geometry fan(float size) {
    return flat({{{0, 0, 0}, {0, 0}}, {{1, 0, 0}, {1, 0}}, {{0, 1, 0}, {0, 1}}, {{-size, size, 0}, {-size, 0.5f * size}}},
                {0, 1, 2, 0, 2, 3});
}

TEST(Mikktspace, TrianglesCountByTheirAngleNotByTheirSize) {
    for (const float size : {1.f, 5.f}) {
        const Geometry g = fan(size);
        const std::vector<Vec4> corners = mikktspace_tangents(g, g.uv[0]);
        const Vec3 a{1, 0, 0}, b = normalize(Vec3{1, -0.5f, 0});
        expect_tangent(corners[0], a * (pi / 2) + b * (pi / 4), -1);
        EXPECT_EQ(corners[0], corners[3]) << "both share the vertex";
        expect_tangent(corners[1], a, -1);
        expect_tangent(corners[5], b, -1);
    }
}

TEST(Mikktspace, EqualCornersAreWelded) {
    const Geometry shared = fan(1);
    Geometry apart = shared;
    apart.positions.clear();
    apart.uv[0].clear();
    for (const uint32_t i : shared.indices) {
        apart.positions.push_back(shared.positions[i]);
        apart.uv[0].push_back(shared.uv[0][i]);
    }
    apart.normals.assign(6, {0, 0, 1});
    apart.indices = {0, 1, 2, 3, 4, 5};
    EXPECT_EQ(mikktspace_tangents(apart, apart.uv[0]), mikktspace_tangents(shared, shared.uv[0]));
}

// Two squares side by side whose u grows away from the edge between them.
Geometry mirrored() {
    return flat(
        {{{0, 0, 0}, {0, 1}}, {{0, 1, 0}, {0, 0}}, {{1, 0, 0}, {1, 1}}, {{1, 1, 0}, {1, 0}}, {{-1, 0, 0}, {1, 1}}, {{-1, 1, 0}, {1, 0}}},
        {0, 2, 3, 0, 3, 1, 4, 0, 1, 4, 1, 5});
}

TEST(Mikktspace, MirroredHalvesDoNotMix) {
    const Geometry g = mirrored();
    const std::vector<Vec4> corners = mikktspace_tangents(g, g.uv[0]);
    for (size_t i = 0; i < 6; ++i) expect_tangent(corners[i], {1, 0, 0}, 1);
    for (size_t i = 6; i < 12; ++i) expect_tangent(corners[i], {-1, 0, 0}, -1);
}

TEST(Mikktspace, FansThatTouchInAPointDoNotMix) {
    const Geometry g = flat({{{0, 0, 0}, {0, 0}}, {{1, 0, 0}, {1, 0}}, {{1, 1, 0}, {1, 1}}, {{-1, 0, 0}, {0, 1}}, {{-1, -1, 0}, {-1, 1}}},
                            {0, 1, 2, 0, 3, 4});
    const std::vector<Vec4> corners = mikktspace_tangents(g, g.uv[0]);
    expect_tangent(corners[0], {1, 0, 0}, -1);
    expect_tangent(corners[3], {0, 1, 0}, -1);
}

TEST(Mikktspace, DegenerateUvsFollowTheirNeighbours) {
    // The third corner of the second triangle lies on the line between the others in the texture.
    const Geometry g =
        flat({{{0, 0, 0}, {0, 0}}, {{1, 0, 0}, {0, 1}}, {{1, 1, 0}, {-1, 1}}, {{0, 1, 0}, {-0.5f, 0.5f}}}, {0, 1, 2, 0, 2, 3});
    const std::vector<Vec4> corners = mikktspace_tangents(g, g.uv[0]);
    for (const size_t i : {0u, 1u, 2u, 3u, 4u}) expect_tangent(corners[i], {0, -1, 0}, -1);
    EXPECT_NEAR(dot(Vec3{corners[5].x, corners[5].y, corners[5].z}, Vec3{0, 0, 1}), 0, 1e-6);
}

TEST(Mikktspace, TrianglesWithoutAreaChangeNothing) {
    Geometry g = fan(1);
    const std::vector<Vec4> without = mikktspace_tangents(g, g.uv[0]);
    g.indices.insert(g.indices.end(), {0, 0, 1, 2, 0, 2});
    const std::vector<Vec4> with = mikktspace_tangents(g, g.uv[0]);
    EXPECT_TRUE(std::equal(without.begin(), without.end(), with.begin()));
    EXPECT_EQ(with[6], without[0]) << "it takes what others at the vertex have";
}

TEST(Mikktspace, NormalsThatDifferKeepVerticesApart) {
    Geometry g = fan(1);
    g.positions.insert(g.positions.end(), {g.positions[0], g.positions[2]});
    g.uv[0].insert(g.uv[0].end(), {g.uv[0][0], g.uv[0][2]});
    g.normals.assign(6, {0, 0, 1});
    g.normals[4] = g.normals[5] = normalize(Vec3{0.5f, 0, 1});
    g.indices = {0, 1, 2, 4, 5, 3};
    const std::vector<Vec4> corners = mikktspace_tangents(g, g.uv[0]);
    expect_tangent(corners[0], {1, 0, 0}, -1);
    for (const size_t i : {3u, 4u}) {
        const Vec3 t{corners[i].x, corners[i].y, corners[i].z};
        EXPECT_NEAR(dot(t, g.normals[4]), 0, 1e-6) << "in the plane of its own normal";
        EXPECT_NEAR(length(t), 1, 1e-6);
    }
}

TEST(GltfTangents, VerticesWithDifferentTangentsAreSplit) {
    Geometry g = mirrored();
    g.colors.assign(6, {1, 1, 1, 1});
    g.colors[0] = {0.5f, 1, 1, 1};
    const Geometry before = g;
    add_tangents(g, 0);
    EXPECT_EQ(g.generated_tangents->copies, (std::vector<uint32_t>{0, 1}));
    ASSERT_EQ(g.positions.size(), 8u);
    for (const size_t n : {g.normals.size(), g.colors.size(), g.uv[0].size(), g.tangents.size()}) EXPECT_EQ(n, 8u);
    EXPECT_EQ(g.colors[6], before.colors[0]);
    for (size_t i = 0; i < g.indices.size(); ++i) {
        const uint32_t now = g.indices[i], then = before.indices[i];
        EXPECT_EQ(g.positions[now], before.positions[then]);
        EXPECT_EQ(g.uv[0][now], before.uv[0][then]);
        expect_tangent(g.tangents[now], {i < 6 ? 1.f : -1.f, 0, 0}, i < 6 ? 1.f : -1.f);
    }
    Geometry regular = fan(1);
    add_tangents(regular, 0);
    EXPECT_TRUE(regular.generated_tangents->copies.empty()) << "nothing to split";
}

TEST(GltfTangents, GeneratedTangentsCanBeRemoved) {
    Geometry before = mirrored();
    before.colors.assign(6, {1, 0, 1, 1});
    for (uint16_t i = 0; i < 12; ++i) before.influences.push_back({i, 0.5f});
    const std::vector<Vec3> offsets(6, {1, 2, 3});
    before.targets.push_back(std::make_shared<MorphTarget>(MorphTarget{offsets, {}, {}}));
    Geometry g = before;
    add_tangents(g, 0);
    ASSERT_EQ(g.influences.size(), 16u);
    const GeometryPtr made = std::make_shared<const Geometry>(g), bare = without_generated_tangents(made);
    EXPECT_NE(bare->serial, made->serial);
    EXPECT_EQ(bare->indices, before.indices);
    EXPECT_EQ(bare->positions, before.positions);
    EXPECT_EQ(bare->normals, before.normals);
    EXPECT_EQ(bare->uv, before.uv);
    EXPECT_EQ(bare->colors, before.colors);
    EXPECT_TRUE(std::ranges::equal(bare->influences, before.influences, {}, &Influence::joint, &Influence::joint));
    EXPECT_EQ(bare->targets[0]->positions, offsets);
    EXPECT_TRUE(bare->tangents.empty() && !bare->generated_tangents);
    EXPECT_EQ(without_generated_tangents(bare), bare);
}

} // namespace
} // namespace blush::TEST_FILE
