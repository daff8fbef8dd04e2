// Gizmo handles: hit testing, and transforms of nodes with arbitrary parents.
#include "ui/transform/gizmo.h"
#include "ui/transform/rotation.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

constexpr double close = 1e-4;

void expect_near(const Vec3d& a, const Vec3d& b) {
    EXPECT_NEAR(a.x, b.x, close);
    EXPECT_NEAR(a.y, b.y, close);
    EXPECT_NEAR(a.z, b.z, close);
}

struct Setting {
    View view;
    ImageRect image{100, 50, 800, 600};
    Setting() {
        view.position = {0, 0, 10};
        view.lens.yfov_radians = 1;
    }
    Projection projection() const { return {view, 800.0 / 600.0}; }
    ViewRay ray_at(ScreenPoint p) const { return projection().ray(image.u(p.x), image.v(p.y)); }
};

GizmoPlace at(const Vec3d& position, TransformMode mode = TransformMode::grab) { return {.mode = mode, .position = position}; }

const HandleShape* shape_of(const std::vector<HandleShape>& shapes, Handle handle) {
    for (const HandleShape& s : shapes)
        if (s.handle == handle) return &s;
    return nullptr;
}

TEST(Handles, AreOnTheAxesExceptTheOneTowardsTheCamera) {
    const Setting s;
    const auto shapes = handle_shapes(s.projection(), s.image, at({0, 0, 0}), {});
    const HandleShape *x = shape_of(shapes, Handle::move_x), *y = shape_of(shapes, Handle::move_y);
    ASSERT_TRUE(x && y);
    EXPECT_NEAR(x->from.x, 500, 0.1);
    EXPECT_NEAR(x->from.y, 350, 0.1);
    EXPECT_NEAR(x->grip.x, 580, 0.5);
    EXPECT_NEAR(y->grip.y, 270, 0.5);
    EXPECT_FALSE(shape_of(shapes, Handle::move_z));
    EXPECT_FALSE(shape_of(shapes, Handle::aim));
}

TEST(Handles, NoneBehindTheCamera) {
    const Setting s;
    EXPECT_TRUE(handle_shapes(s.projection(), s.image, at({0, 0, 11}), Vec3d{0, 0, 0}).empty());
}

TEST(Handles, GripsHavePriorityOverLines) {
    const Setting s;
    const auto shapes = handle_shapes(s.projection(), s.image, at({0, 0, 0}), Vec3d{2, 2, 0});
    EXPECT_EQ(handle_under(shapes, {500, 350}, 12), Handle::move);
    EXPECT_EQ(handle_under(shapes, {580, 350}, 12), Handle::move_x);
    EXPECT_EQ(handle_under(shapes, {545, 352}, 12), Handle::move_x);
    EXPECT_EQ(handle_under(shapes, {545, 370}, 12), Handle::none);
    const HandleShape* aim = shape_of(shapes, Handle::aim);
    ASSERT_TRUE(aim);
    EXPECT_EQ(handle_under(shapes, aim->grip, 12), Handle::aim);
}

TEST(Rings, ShowTheirNearHalfAndAreHitOnTheirLine) {
    Setting s;
    s.view.position = {6, 5, 7};
    s.view.rotation = looking_along({-6, -5, -7});
    const auto shapes = handle_shapes(s.projection(), s.image, at({0, 0, 0}, TransformMode::rotate), {});
    for (const Handle handle : {Handle::rotate_x, Handle::rotate_y, Handle::rotate_z}) {
        const HandleShape* ring = shape_of(shapes, handle);
        ASSERT_TRUE(ring);
        EXPECT_LT(ring->ring.size(), 60u); // of 97 points
        EXPECT_GT(ring->ring.size(), 40u);
        // A point away from the crossings hits this ring; the centre hits none.
        EXPECT_EQ(handle_under(shapes, ring->ring[ring->ring.size() / 2], 12), handle);
    }
    EXPECT_EQ(handle_under(shapes, {500, 350}, 12), Handle::none);
    const HandleShape* round = shape_of(shapes, Handle::rotate);
    ASSERT_TRUE(round);
    for (const ScreenPoint p : round->ring) EXPECT_NEAR(std::hypot(p.x - 500, p.y - 350), 100, 3);
    EXPECT_FALSE(shape_of(shapes, Handle::move_x));
}

TEST(Rings, TheAngleUnderTheMouseIsRightHandedAboutTheAxis) {
    Setting s;
    s.view.position = {6, 5, 7};
    s.view.rotation = looking_along({-6, -5, -7});
    const Vec3d centre{0.5, -0.2, 0.3};
    for (int i = 0; i < 3; ++i) {
        const Vec3d axis = std::array<Vec3d, 3>{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}[size_t(i)];
        const Vec3d x = any_perpendicular(axis), y = cross(axis, x);
        const auto angle_at = [&](double a) {
            const auto seen = s.projection().project(centre + x * std::cos(a) + y * std::sin(a));
            return ring_angle(s.projection().ray(seen->u, seen->v), centre, axis);
        };
        const auto from = angle_at(0.3), to = angle_at(1.1);
        ASSERT_TRUE(from && to);
        EXPECT_NEAR(*to - *from, 0.8, 1e-6);
    }
    EXPECT_FALSE(ring_angle({{0, 0, 10}, {0, 0, -1}}, {0, 0, 0}, {1, 0, 0})) << "edge-on";
}

TEST(Rings, EdgeOnRingFollowsADragOfItsNearSide) {
    const Setting s;
    // About +Y, seen from +Z: the near side goes to the right.
    EXPECT_NEAR(edge_on_ring_angle(s.projection(), {0, 0, 0}, {0, 1, 0}, {500, 350}, {540, 300}, 80), 0.5, 1e-6);
    EXPECT_NEAR(edge_on_ring_angle(s.projection(), {0, 0, 0}, {1, 0, 0}, {500, 350}, {540, 390}, 80), 0.5, 1e-6) << "about +X it goes down";
}

TEST(ScaleBoxes, HaveAUniformHandleAndValidAxisHandles) {
    Setting s;
    GizmoPlace place = at({0, 0, 0}, TransformMode::scale);
    place.axes = {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}}; // turned by 90 degrees
    const auto shapes = handle_shapes(s.projection(), s.image, place, {});
    EXPECT_TRUE(shape_of(shapes, Handle::scale));
    const HandleShape* x = shape_of(shapes, Handle::scale_x);
    ASSERT_TRUE(x);
    EXPECT_NEAR(x->grip.y, 270, 0.5);
    place.along_axes = false;
    EXPECT_EQ(handle_shapes(s.projection(), s.image, place, {}).size(), 1u);
}

TEST(MeetPlane, NothingBehindOrParallel) {
    EXPECT_FALSE(meet_plane({{0, 0, 0}, {0, 0, -1}}, {0, 0, 5}, {0, 0, 1}));
    EXPECT_FALSE(meet_plane({{0, 0, 0}, {1, 0, 0}}, {0, 0, -5}, {0, 0, 1}));
    const auto p = meet_plane({{1, 2, 0}, {0, 0, -1}}, {0, 0, -5}, {0, 0, 1});
    ASSERT_TRUE(p);
    expect_near(*p, {1, 2, -5});
}

// A child of a translated, rotated and non-uniformly scaled parent.
struct Family {
    Scene scene;
    Id<Node> parent, child;
    Family() {
        Node p;
        p.local = {{1, 2, 3}, from_euler_degrees({20, 130, -40}), {2, 0.5f, 3}, {}};
        parent = scene.nodes.add(p);
        Node c;
        c.parent = parent;
        c.local = {{0.5f, 0, -1}, from_euler_degrees({5, 6, 7}), {1, 1, 1}, {}};
        child = scene.nodes.add(c);
    }
    void place(const Transform& local) {
        Node c = *scene.nodes.find(child);
        c.local = local;
        scene.nodes.set(child, c);
    }
};

TEST(Place, NodeIsPlacedUnderAnyParent) {
    Family f;
    f.place(moved_to(f.scene, f.child, {-4, 5, 6}));
    expect_near(world_from_node(f.scene, f.child).t, {-4, 5, 6});
}

TEST(Place, NodeIsAimedUnderAnyParent) {
    Family f;
    const Vec3d origin = world_from_node(f.scene, f.child).t, direction = normalize(Vec3d{1, -2, 0.5});
    f.place(rotated_to(f.scene, f.child, looking_along(direction)));
    expect_near(world_from_node(f.scene, f.child).t, origin);
    expect_near(rotate(world_rotation(f.scene, f.child), {0, 0, -1}), direction);
}

TEST(Place, NodeUnderAParentOfScaleZeroStays) {
    Family f;
    Node p = *f.scene.nodes.find(f.parent);
    p.local.scale = {0, 1, 1};
    f.scene.nodes.set(f.parent, p);
    EXPECT_EQ(moved_to(f.scene, f.child, {9, 9, 9}), f.scene.nodes.find(f.child)->local);
}

} // namespace
} // namespace blush::TEST_FILE
