#include "scene/affine.h"
#include "scene/validate.h"
#include "scene/world_transforms.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace blush::TEST_FILE {
namespace {

using test::Sample;
using test::sample_project;

double distance(const Affined& a, const Affined& b) {
    return std::max({length(a.x - b.x), length(a.y - b.y), length(a.z - b.z), length(a.t - b.t)});
}

Transform random_trs(std::mt19937& rng) {
    std::normal_distribution<float> n;
    std::uniform_real_distribution<float> scale(0.05f, 20);
    Transform t;
    t.translation = {n(rng), n(rng), n(rng)};
    t.rotation = {n(rng), n(rng), n(rng), n(rng)};
    t.scale = {scale(rng), rng() % 2 ? scale(rng) : -scale(rng), scale(rng)};
    return t;
}

TEST(Transform, AppliesScaleThenRotationThenTranslation) {
    Transform t;
    t.translation = {1, 2, 3};
    t.rotation = {0, 0, std::sqrt(0.5f), std::sqrt(0.5f)}; // a quarter turn from +X to +Y
    t.scale = {2, 3, 4};
    const Vec3d p = transform_point(to_affine(t), {1, 1, 1});
    EXPECT_NEAR(p.x, 1 - 3, 1e-6);
    EXPECT_NEAR(p.y, 2 + 2, 1e-6);
    EXPECT_NEAR(p.z, 3 + 4, 1e-6);
}

TEST(Transform, DecomposedMatricesRoundTrip) {
    std::mt19937 rng(1);
    for (int i = 0; i < 2000; ++i) {
        const Affined m = to_affine(random_trs(rng));
        const Transform t = to_transform(m);
        ASSERT_FALSE(t.matrix);
        EXPECT_LT(distance(to_affine(t), m), 1e-5 * 20 * std::sqrt(3.0)) << "relative to the largest column";
    }
}

TEST(Transform, ShearIsKeptAsAMatrix) {
    Affined shear;
    shear.y = {0.5, 1, 0};
    const Transform t = to_transform(shear);
    ASSERT_TRUE(t.matrix);
    EXPECT_EQ(to_affine(t), shear);
}

TEST(Transform, FlattenedAxesKeepTheirRotation) {
    std::mt19937 rng(2);
    for (const Vec3 scale : {Vec3{0, 2, 3}, Vec3{2, 0, 3}, Vec3{2, 3, 0}, Vec3{0, 0, 3}, Vec3{2, 0, 0}, Vec3{0, 0, 0}}) {
        Transform flat = random_trs(rng);
        flat.scale = scale;
        const Affined m = to_affine(flat);
        const Transform t = to_transform(m);
        EXPECT_FALSE(t.matrix);
        EXPECT_LT(distance(to_affine(t), m), 1e-5);
    }
}

TEST(Transform, NonFiniteMatricesDoNotBecomeRotations) {
    Affined m;
    m.x.x = NAN;
    EXPECT_TRUE(to_transform(m).matrix);
}

TEST(Quaternions, RoundTrip) {
    std::mt19937 rng(3);
    std::normal_distribution<double> n;
    for (int i = 0; i < 2000; ++i) {
        Vec3d z = normalize(Vec3d{n(rng), n(rng), n(rng)});
        if (i % 10 == 0) z = {0, 0, i % 20 ? 1.0 : -1.0}; // half turns, where a naive formula divides by zero
        const Vec3d x = any_perpendicular(z);
        const Affined m{x, cross(z, x), z, {0, 0, 0}};
        EXPECT_LT(distance(to_affine(to_quat(m)), m), 1e-6);
        EXPECT_GE(to_quat(m).w, 0);
    }
}

TEST(WorldFromNode, IsTheProductUpTheTree) {
    Sample s = sample_project();
    std::mt19937 rng(4);
    const auto place = [&](Id<Node> id) {
        Node node = *s.project.scene.nodes.find(id);
        node.local = random_trs(rng);
        s.project.scene.nodes.set(id, node);
        return to_affine(node.local);
    };
    const Affined world_from_root = place(s.root), root_from_mug = place(s.mug);
    EXPECT_EQ(world_from_node(s.project.scene, s.mug), world_from_root * root_from_mug);
    EXPECT_EQ(world_from_node(s.project.scene, s.root), world_from_root);
    EXPECT_EQ(world_from_node(s.project.scene, {}), Affined{});
}

TEST(WorldFromNode, EndsOnACycle) {
    Scene scene;
    const Id<Node> id = scene.nodes.add({});
    Node node;
    node.parent = id;
    node.local.translation = {1, 0, 0};
    scene.nodes.set(id, node);
    EXPECT_TRUE(std::isfinite(world_from_node(scene, id).t.x));
    EXPECT_TRUE(is_visible(scene, id));
}

// A chain so deep that an algorithm of quadratic time does not finish.
TEST(WorldTransforms, DeepChainsTakeLinearTime) {
    constexpr int depth = 100'000;
    Scene scene;
    Node node;
    node.local.translation = {0.25f, 0, 0};
    node.mesh = scene.meshes.add({"", {{test::quad_geometry(), {}}}});
    for (int i = 0; i < depth; ++i) {
        node.visible = i != depth - 10;
        node.parent = scene.nodes.add(node);
    }
    EXPECT_TRUE(validate(scene));
    EXPECT_EQ(world_bounds(scene).high.x, 0.5 + 0.25 * (depth - 10));

    WorldTransforms transforms(scene);
    for (const auto& [id, unused] : scene.nodes) EXPECT_EQ(transforms(id).visible, id.value <= depth - 10);
    for (const uint32_t id : {1u, 2u, 777u, uint32_t(depth)})
        EXPECT_EQ(transforms({id}).world_from_node, world_from_node(scene, {id})) << id;
}

TEST(IsVisible, NeedsAllAncestors) {
    Sample s = sample_project();
    EXPECT_TRUE(is_visible(s.project.scene, s.mug));
    Node root = *s.project.scene.nodes.find(s.root);
    root.visible = false;
    s.project.scene.nodes.set(s.root, root);
    EXPECT_FALSE(is_visible(s.project.scene, s.mug));
    EXPECT_FALSE(is_visible(s.project.scene, s.root));
    EXPECT_TRUE(is_visible(s.project.scene, s.table));
    EXPECT_FALSE(is_visible(s.project.scene, {99}));
}

TEST(WorldBounds, HoldTheVisibleGeometry) {
    Sample s = sample_project();
    const Bounds mug = world_bounds(s.project.scene, s.mug);
    EXPECT_NEAR(mug.low.x, 0.2 - 0.5, 1e-6);
    EXPECT_NEAR(mug.high.x, 0.2 + 0.5, 1e-6);
    const Bounds all = world_bounds(s.project.scene);
    EXPECT_EQ(all.low, (Vec3d{-2, -2, -0.5}));
    EXPECT_EQ(all.high, (Vec3d{2, 2, 0.5}));
    Node table = *s.project.scene.nodes.find(s.table);
    table.visible = false;
    s.project.scene.nodes.set(s.table, table);
    EXPECT_EQ(world_bounds(s.project.scene).low, mug.low);
    EXPECT_TRUE(world_bounds(s.project.scene, s.lamp_node).empty);
}

TEST(WorldBounds, IgnoreNonFiniteValues) {
    Bounds b;
    b.include({NAN, 0, 0});
    EXPECT_TRUE(b.empty);
    b.include({1, 2, 3});
    b.include({0, INFINITY, 0});
    EXPECT_EQ(b.high, (Vec3d{1, 2, 3}));
    EXPECT_EQ(b.radius(), 0);
}

// To the bit, also where a corner overflows.
TEST(WorldBounds, OfABoxAreThoseOfItsCorners) {
    std::mt19937 rng(7);
    std::normal_distribution<double> n;
    for (int i = 0; i < 2000; ++i) {
        const double size = i % 4 == 0 ? 1e308 : 1;
        const auto vector = [&](double scale) { return Vec3d{n(rng) * scale, n(rng) * scale, n(rng) * scale}; };
        const Affined m{vector(size), vector(1), vector(1), vector(size)};
        Bounds box, corners, all;
        for (int k = 0; k < 2; ++k) box.include(vector(3));
        for (int k = 0; k < 8; ++k)
            corners.include(
                transform_point(m, Vec3d{k & 1 ? box.high.x : box.low.x, k & 2 ? box.high.y : box.low.y, k & 4 ? box.high.z : box.low.z}));
        all.include(box, m);
        EXPECT_EQ(all.empty, corners.empty);
        EXPECT_EQ(all.low, corners.low) << i;
        EXPECT_EQ(all.high, corners.high) << i;
    }
}

// Every corner of the box is inside the image, and the sphere around it touches the narrower border.
TEST(Framed, ShowsTheWholeBounds) {
    std::mt19937 rng(5);
    std::normal_distribution<double> n;
    for (int i = 0; i < 500; ++i) {
        View view;
        view.rotation = {float(n(rng)), float(n(rng)), float(n(rng)), float(n(rng))};
        view.lens.orthographic = i % 2;
        view.lens.yfov_radians = float(0.3 + 2 * (i / 500.0));
        const float aspect = i % 3 ? 16.f / 9 : 0.5f;
        Bounds bounds;
        for (int k = 0; k < 3; ++k) bounds.include({n(rng), n(rng), n(rng)});
        const View f = framed(view, bounds, aspect);
        EXPECT_EQ(f.rotation, view.rotation);
        const Affined axes = to_affine(f.rotation);
        double max_extrapolation = 0; // of the corners from the middle, in half images
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3d p{corner & 1 ? bounds.low.x : bounds.high.x, corner & 2 ? bounds.low.y : bounds.high.y,
                          corner & 4 ? bounds.low.z : bounds.high.z};
            const Vec3d v = p - to_double(f.position);
            const double depth = -dot(v, axes.z);
            ASSERT_GT(depth, 0);
            const double half_height = f.lens.orthographic ? f.lens.ymag : depth * std::tan(0.5 * f.lens.yfov_radians);
            max_extrapolation =
                std::max({max_extrapolation, std::abs(dot(v, axes.y)) / half_height, std::abs(dot(v, axes.x)) / (half_height * aspect)});
        }
        EXPECT_LE(max_extrapolation, 1 + 1e-5);
        if (f.lens.orthographic) {
            EXPECT_NEAR(f.lens.ymag * std::min(1.f, aspect), bounds.radius(), 1e-5);
        } else {
            const double half_height = 0.5 * f.lens.yfov_radians;
            const double narrower = std::min(half_height, std::atan(std::tan(half_height) * aspect));
            EXPECT_NEAR(std::asin(bounds.radius() / f.pivot_distance), narrower, 1e-5);
        }
        const Vec3d pivot = to_double(f.position) - axes.z * double(f.pivot_distance);
        EXPECT_LT(length(pivot - bounds.center()), 1e-4);
    }
}

TEST(Framed, EmptyBoundsLeaveTheView) { EXPECT_EQ(framed(View{}, Bounds{}, 1), View{}); }

TEST(Framed, APointIsSeenFromOutside) {
    Bounds point;
    point.include({1, 2, 3});
    EXPECT_GT(framed(View{}, point, 1).pivot_distance, 0);
}

TEST(ViewThrough, TakesPoseAndLensAndOrbitsTheScene) {
    const Sample s = sample_project();
    const View view = view_through(s.project.scene, s.camera_node);
    EXPECT_EQ(view.position, (Vec3{0, 0, 4}));
    EXPECT_EQ(view.rotation, Quat{});
    EXPECT_FLOAT_EQ(view.pivot_distance, 4);
    EXPECT_EQ(view.lens, s.project.scene.cameras.find(s.camera)->lens);
}

TEST(ViewThrough, IgnoresTheScaleOfTheCamera) {
    Sample s = sample_project();
    Node node = *s.project.scene.nodes.find(s.camera_node);
    node.local.scale = {2, 3, 4};
    node.local.rotation = {0.5f, 0.5f, 0.5f, 0.5f};
    s.project.scene.nodes.set(s.camera_node, node);
    const Quat q = view_through(s.project.scene, s.camera_node).rotation;
    for (const float c : {q.x, q.y, q.z, q.w}) EXPECT_NEAR(c, 0.5f, 1e-6);
}

TEST(ViewThrough, WithoutACameraTheViewStays) {
    const Sample s = sample_project();
    EXPECT_EQ(view_through(s.project.scene, s.mug), s.project.scene.view);
}

} // namespace
} // namespace blush::TEST_FILE
