// Morphing and skinning against positions computed by hand.
#include "core/math.h"
#include "core/parallel.h"
#include "scene/affine.h"
#include "scene/animation/deform.h"
#include "scene/animation/pose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace blush::TEST_FILE {
namespace {

constexpr float half_sqrt2 = 0.70710678f;

void expect_near(const Vec3d& a, const Vec3d& b, const char* what) {
    EXPECT_NEAR(a.x, b.x, 1e-6) << what;
    EXPECT_NEAR(a.y, b.y, 1e-6) << what;
    EXPECT_NEAR(a.z, b.z, 1e-6) << what;
}

// A strip along Y: corners at the heights 0, 1 and 2. The lower joint is at the origin, the upper one at height 1 below it; the middle
// corners follow both in the same way.
struct Strip {
    Scene scene;
    Id<Node> lower, upper, body;

    Strip() {
        auto g = std::make_shared<Geometry>();
        for (int i = 0; i < 3; ++i) {
            g->positions.insert(g->positions.end(), {{-0.5f, float(i), 0}, {0.5f, float(i), 0}});
            const float above = float(i) / 2;
            for (int k = 0; k < 2; ++k) g->influences.insert(g->influences.end(), {{0, 1 - above}, {1, above}});
        }
        g->normals.assign(6, {0, 0, 1});
        g->tangents.assign(6, {1, 0, 0, -1});
        g->indices = {0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4};
        auto taller = std::make_shared<MorphTarget>();
        taller->positions.assign(6, {0, 0, 0});
        taller->positions[4] = taller->positions[5] = {0, 1, 0};
        taller->normals.assign(6, {0, 0, 0});
        taller->normals[4] = {0, 3, 3};
        g->targets.push_back(taller);

        Node joint;
        lower = scene.nodes.add(joint);
        joint.parent = lower;
        joint.local.translation = {0, 1, 0};
        upper = scene.nodes.add(joint);
        Affine down;
        down.t = {0, -1, 0};
        Node strip;
        strip.mesh = scene.meshes.add({"Strip", {{g, {}}}});
        strip.skin = scene.skins.add({"Bones", {lower, upper}, {Affine{}, down}});
        body = scene.nodes.add(strip);
    }
    void change(Id<Node> id, auto&& with) {
        Node node = *scene.nodes.find(id);
        with(node);
        scene.nodes.set(id, node);
    }
    // In the world.
    std::vector<Vec3d> positions() const {
        WorldTransforms transforms(scene);
        const DeformedMesh mesh = deformed_mesh(scene, transforms, body, *scene.nodes.find(body));
        std::vector<Vec3d> corners;
        for (const Vec3& p : mesh.parts[0].geometry->positions) corners.push_back(transform_point(mesh.world_from_mesh, to_double(p)));
        return corners;
    }
    GeometryPtr deformed_geometry() const {
        WorldTransforms transforms(scene);
        return deformed_mesh(scene, transforms, body, *scene.nodes.find(body)).parts[0].geometry;
    }
};

TEST(Skins, AtRestAreWhereTheMeshIs) {
    const Strip strip;
    const auto corners = strip.positions();
    for (size_t i = 0; i < corners.size(); ++i) expect_near(corners[i], {i % 2 ? 0.5 : -0.5, double(i / 2), 0}, "corner");
}

TEST(Skins, AJointDeformsItsVertices) {
    Strip strip;
    // A quarter turn about Z at height 1: vertices above it move to the left.
    strip.change(strip.upper, [](Node& n) { n.local.rotation = {0, 0, half_sqrt2, half_sqrt2}; });
    const auto corners = strip.positions();
    expect_near(corners[0], {-0.5, 0, 0}, "the lower joint holds still");
    expect_near(corners[1], {0.5, 0, 0}, "the lower joint holds still");
    // (-0.5, 1) turns to (0, 0.5), (0.5, 1) to (0, 1.5): half way between that and where they were.
    expect_near(corners[2], {-0.25, 0.75, 0}, "between both");
    expect_near(corners[3], {0.25, 1.25, 0}, "between both");
    expect_near(corners[4], {-1, 0.5, 0}, "all of the turn");
    expect_near(corners[5], {-1, 1.5, 0}, "all of the turn");
    const GeometryPtr g = strip.deformed_geometry();
    expect_near(to_double(g->normals[4]), {0, 0, 1}, "the axis of the turn");
    expect_near({g->tangents[4].x, g->tangents[4].y, g->tangents[4].z}, {0, 1, 0}, "turns along");
    EXPECT_EQ(g->tangents[4].w, -1);
}

TEST(Skins, TheNodesOwnTransformDoesNotMoveTheMesh) {
    Strip strip;
    strip.change(strip.body, [](Node& n) { n.local.translation = {7, 8, 9}, n.local.scale = {2, 2, 2}; });
    expect_near(strip.positions()[5], {0.5, 2, 0}, "it is where its joints are");
    strip.change(strip.lower, [](Node& n) { n.local.translation = {10, 0, 0}; });
    expect_near(strip.positions()[5], {10.5, 2, 0}, "and goes with them");
    EXPECT_EQ(world_bounds(strip.scene, strip.body).low, (Vec3d{9.5, 0, 0}));
}

// Twice as wide: normals tilt by the inverse transpose.
TEST(Skins, NormalsStayPerpendicularUnderUnevenScales) {
    Strip strip;
    strip.change(strip.lower, [](Node& n) { n.local.scale = {2, 1, 1}; });
    auto slanted = std::make_shared<Geometry>(*strip.scene.meshes.begin()->value.parts[0].geometry);
    slanted->normals.assign(6, {half_sqrt2, half_sqrt2, 0});
    strip.scene.meshes.set(strip.scene.nodes.find(strip.body)->mesh, {"Strip", {{slanted, {}}}});
    const double l = std::sqrt(0.25 + 1);
    expect_near(to_double(strip.deformed_geometry()->normals[0]), {0.5 / l, 1 / l, 0}, "half as steep");
}

TEST(MorphTargets, AreAddedByTheirWeight) {
    Strip strip;
    strip.change(strip.body, [](Node& n) { n.skin = {}, n.morph_weights = {0.5f}, n.local.translation = {0, 0, 1}; });
    expect_near(strip.positions()[4], {-0.5, 2.5, 1}, "half of what the target adds, where the node is");
    expect_near(strip.positions()[3], {0.5, 1, 1}, "does not change");
    const double l = std::sqrt(1.5 * 1.5 + 2.5 * 2.5);
    expect_near(to_double(strip.deformed_geometry()->normals[4]), {0, 1.5 / l, 2.5 / l}, "(0, 0, 1) + 0.5 (0, 3, 3), of length 1");
}

TEST(MorphTargets, ComeBeforeSkins) {
    Strip strip;
    strip.change(strip.body, [](Node& n) { n.morph_weights = {1}; });
    strip.change(strip.upper, [](Node& n) { n.local.rotation = {0, 0, half_sqrt2, half_sqrt2}; });
    expect_near(strip.positions()[5], {-2, 1.5, 0}, "(0.5, 3) about (0, 1)");
}

TEST(MorphTargets, ZeroWeightsReturnTheMeshItself) {
    Strip strip;
    const GeometryPtr rest = strip.scene.meshes.begin()->value.parts[0].geometry;
    strip.change(strip.body, [](Node& n) { n.skin = {}, n.morph_weights = {0}; });
    EXPECT_EQ(strip.deformed_geometry(), rest);
    strip.change(strip.body, [](Node& n) { n.morph_weights = {}; });
    EXPECT_EQ(strip.deformed_geometry(), rest);
}

TEST(Deformation, FlatNormalsFollowTheTriangles) {
    Strip strip;
    auto flat = std::make_shared<Geometry>();
    flat->positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    flat->normals.assign(3, {0, 0, 1});
    flat->indices = {0, 1, 2};
    flat->flat = true;
    auto fold = std::make_shared<MorphTarget>();
    fold->positions = {{0, 0, 0}, {0, 0, 0}, {0, -1, 1}};
    flat->targets.push_back(fold);
    strip.scene.meshes.set(strip.scene.nodes.find(strip.body)->mesh, {"Leaf", {{flat, {}}}});
    strip.change(strip.body, [](Node& n) { n.skin = {}, n.morph_weights = {1}; });
    const GeometryPtr folded = strip.deformed_geometry();
    for (const Vec3& n : folded->normals) EXPECT_EQ(n, (Vec3{0, -1, 0}));
}

TEST(Deformation, NonFiniteVerticesKeepTheRestPose) {
    Strip strip;
    strip.change(strip.body, [](Node& n) { n.skin = {}, n.morph_weights = {3e38f}; });
    auto huge = std::make_shared<Geometry>(*strip.scene.meshes.begin()->value.parts[0].geometry);
    auto far = std::make_shared<MorphTarget>();
    far->positions.assign(6, {3e38f, 0, 0});
    huge->targets = {far};
    strip.scene.meshes.set(strip.scene.nodes.find(strip.body)->mesh, {"Strip", {{huge, {}}}});
    for (const Vec3d& p : strip.positions()) EXPECT_LE(std::abs(p.x), 0.5);
}

// A mesh of many ranges of vertices, all of which move.
TEST(Deformation, IsTheSameForAnyNumberOfThreads) {
    constexpr size_t count = 50001;
    Geometry g;
    auto target = std::make_shared<MorphTarget>();
    for (size_t i = 0; i < count; ++i) {
        const float t = float(i) / float(count);
        g.positions.push_back({std::sin(40 * t), t, std::cos(70 * t)});
        g.normals.push_back({std::sin(9 * t), std::cos(9 * t), 0});
        g.tangents.push_back({0, 0, 1, i % 2 ? 1.f : -1.f});
        g.indices.push_back(uint32_t(i));
        target->positions.push_back({t, 1 - t, 0.3f});
        target->normals.push_back({0, t, t});
        target->tangents.push_back({t, 0, 0});
        g.influences.insert(g.influences.end(), {{0, 1 - t}, {1, t}});
    }
    g.targets.push_back(target);
    Deformation deformation;
    deformation.weights = {0.7f};
    deformation.joints = {Affined{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {1, 2, 3}}, Affined{{1, 0, 0.5}, {0, 2, 0}, {0, 0, 1}, {0, 0, 1}}};
    for (const bool flat : {false, true}) {
        g.flat = flat;
        const GeometryPtr alone = deformed(g, deformation);
        EXPECT_NE(alone->positions.back(), g.positions.back());
        EXPECT_NE(alone->normals.back(), g.normals.back());
        EXPECT_NE(alone->tangents.back(), g.tangents.back());
        for (const unsigned threads : {1u, 2u, 3u, 7u}) {
            const Workers workers(threads);
            const GeometryPtr shared = deformed(g, deformation, &workers);
            EXPECT_EQ(shared->positions, alone->positions) << threads;
            EXPECT_EQ(shared->normals, alone->normals) << threads;
            EXPECT_EQ(shared->tangents, alone->tangents) << threads;
            EXPECT_EQ(shared->indices, g.indices);
        }
    }
}

TEST(Deformation, MissingJointsAreHandled) {
    Strip strip;
    strip.scene.nodes.remove(strip.upper);
    expect_near(strip.positions()[0], {-0.5, 0, 0}, "the other joint is there");
    for (const Vec3d& p : strip.positions()) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
    auto stray = std::make_shared<Geometry>(*strip.scene.meshes.begin()->value.parts[0].geometry);
    for (Influence& by : stray->influences) by.joint = 9;
    strip.scene.meshes.set(strip.scene.nodes.find(strip.body)->mesh, {"Strip", {{stray, {}}}});
    strip.change(strip.body, [](Node& n) { n.local.translation = {0, 0, 4}; });
    expect_near(strip.positions()[0], {-0.5, 0, 4}, "stays with the node");
}

} // namespace
} // namespace blush::TEST_FILE
