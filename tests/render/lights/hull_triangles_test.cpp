// The triangles of a mesh on its convex hull: as by comparing every triangle with every vertex.
#include "render/lights/hull_triangles.h"

#include "core/math.h"
#include "scene/affine.h"
#include "tests/render/lights/lamp_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace blush::test::TEST_FILE {
namespace {

std::vector<uint8_t> hull_of(const Geometry& mesh, unsigned threads = 1) { return hull_triangles(mesh, Workers(threads)); }
int64_t count_on_hull(const Geometry& mesh) {
    const std::vector<uint8_t> on_hull = hull_of(mesh);
    return std::ranges::count(on_hull, 1);
}

// Height of the highest vertex above the plane of a triangle.
double height_above(const Geometry& mesh, size_t triangle) {
    const auto corner = [&](size_t k) { return to_double(mesh.positions[mesh.indices[3 * triangle + k]]); };
    const Vec3d normal = normalize(cross(corner(1) - corner(0), corner(2) - corner(0)));
    double highest = 0;
    for (const uint32_t i : mesh.indices) highest = std::max(highest, dot(normal, to_double(mesh.positions[i]) - corner(0)));
    return highest;
}

TEST(HullTriangles, OfConvexMeshesAreAll) {
    for (const GeometryPtr& mesh : {sphere(false), cube(false), grid_cube(9), capsule(12, 24, 1.5f), grid_quad(6)})
        EXPECT_EQ(count_on_hull(*mesh), int64_t(mesh->triangle_count()));
    // Far from its own origin, in coordinates of steps of 1e-4 of its size; only triangles smaller than these steps may be lost.
    Geometry far = *ball(300, 600);
    for (Vec3& p : far.positions) p = p + Vec3{900, -700, 1000};
    EXPECT_GT(count_on_hull(far), int64_t(far.triangle_count()) * 3 / 4);
}

TEST(HullTriangles, OfAnOpenShellAreThoseOfItsOutside) {
    const GeometryPtr dome = hemisphere(16, 32, false), bowl = hemisphere(16, 32, true);
    EXPECT_EQ(count_on_hull(*dome), int64_t(dome->triangle_count()));
    EXPECT_EQ(count_on_hull(*bowl), 0);
    EXPECT_EQ(count_on_hull(*sphere(true)), 0) << "inverted orientation";
}

TEST(HullTriangles, OfATorusAreItsOuterHalf) {
    const GeometryPtr mesh = torus(48, 24, 1, 0.4f);
    const std::vector<uint8_t> on_hull = hull_of(*mesh);
    for (size_t t = 0; t < on_hull.size(); ++t) {
        Vec3 center{0, 0, 0};
        for (size_t k = 0; k < 3; ++k) center = center + mesh->positions[mesh->indices[3 * t + k]] * (1.f / 3);
        const float outward = std::hypot(center.x, center.z) - 1;
        if (std::abs(outward) > 0.06f) { EXPECT_EQ(on_hull[t], outward > 0) << t; }
    }
}

TEST(HullTriangles, OfTwoCubesAreNotTheFacesBetweenThem) {
    const GeometryPtr both = joined({grid_cube(4), moved(grid_cube(4), {3, 0, 0})});
    const std::vector<uint8_t> on_hull = hull_of(*both);
    EXPECT_EQ(std::ranges::count(on_hull, 0), 2 * 2 * 4 * 4);
    for (size_t t = 0; t < on_hull.size(); ++t) EXPECT_EQ(on_hull[t], height_above(*both, t) < 1e-6) << t;
}

TEST(HullTriangles, ADentOrASpikeCostsOnlyWhatItHides) {
    const auto ball_with_vertex = [](float radius) {
        Geometry g = *ball(20, 40);
        g.positions[10 * 40 + 7] = g.positions[10 * 40 + 7] * radius;
        return g;
    };
    EXPECT_EQ(count_on_hull(ball_with_vertex(1)), int64_t(ball(20, 40)->triangle_count()));
    for (const float radius : {0.97f, 1.2f}) {
        const Geometry mesh = ball_with_vertex(radius);
        const std::vector<uint8_t> on_hull = hull_of(mesh);
        EXPECT_GT(std::ranges::count(on_hull, 1), 1000);
        EXPECT_GT(std::ranges::count(on_hull, 0), 5);
        for (size_t t = 0; t < on_hull.size(); ++t) EXPECT_EQ(on_hull[t], height_above(mesh, t) < 1e-6) << t;
    }
}

// Clouds, shells and single vertices out of place, of all sizes, on several threads.
TEST(HullTriangles, AreThoseFoundByComparingAllVertices) {
    std::mt19937 bits(7);
    const auto random = [&](float low, float high) { return low + (high - low) * float(bits() >> 8) * 0x1p-24f; };
    int64_t on = 0, off = 0, near = 0;
    for (int round = 0; round < 60; ++round) {
        Geometry g = *ball(3 + uint32_t(bits() % 20), 3 + uint32_t(bits() % 40));
        const float noise = std::exp(random(-14, -1)), scale = std::exp(random(-12, 12));
        const Vec3 stretch{random(0.01f, 1), random(0.1f, 1), 1}, shift{random(-3, 3), random(-3, 3), random(-3, 3)};
        for (Vec3& p : g.positions) p = (p * (1 + random(-noise, noise)) * stretch + shift) * scale;
        const std::vector<uint8_t> on_hull = hull_of(g, 1 + unsigned(round % 3));
        for (size_t t = 0; t < on_hull.size(); ++t) {
            const double height = height_above(g, t) / double(scale);
            if (height < 0.7e-6)
                EXPECT_TRUE(on_hull[t]) << round << ": " << t << ' ' << height;
            else if (height > 5e-6)
                EXPECT_FALSE(on_hull[t]) << round << ": " << t << ' ' << height;
            else
                ++near;
            ++(on_hull[t] ? on : off);
        }
    }
    EXPECT_GT(on, 5000);
    EXPECT_GT(off, 5000);
    EXPECT_LT(near, (on + off) / 10) << "between the bounds, nothing is asserted";
}

TEST(HullTriangles, DoNotHaveAreaZeroOrVerticesAtInfinity) {
    Geometry g = *grid_quad(6);
    g.indices.insert(g.indices.end(), {0, 0, 1});
    std::vector<uint8_t> on_hull = hull_of(g);
    EXPECT_EQ(on_hull.back(), 0);
    EXPECT_EQ(std::ranges::count(on_hull, 0), 1);
    g.positions.push_back({std::numeric_limits<float>::infinity(), 0, 0});
    EXPECT_EQ(count_on_hull(g), std::ranges::count(on_hull, 1)) << "no triangle uses that vertex";
    g.indices.back() = uint32_t(g.positions.size()) - 1;
    EXPECT_EQ(count_on_hull(g), 0);
    EXPECT_TRUE(hull_of(Geometry{}).empty());
}

} // namespace
} // namespace blush::test::TEST_FILE
