// Handles: where they are grabbed, where they carry a node, whatever its parents are.
#include "ui/gizmo.h"
#include "ui/rotation.h"

#include <gtest/gtest.h>

namespace blush {
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

const HandleShape* shape_of(const std::vector<HandleShape>& shapes, Handle handle) {
    for (const HandleShape& s : shapes)
        if (s.handle == handle) return &s;
    return nullptr;
}

TEST(Handles, LieOnTheAxesAndLeaveOutTheOneThatPointsAtTheEye) {
    const Setting s;
    const auto shapes = handle_shapes(s.projection(), s.image, {0, 0, 0}, {}, 80);
    const HandleShape *x = shape_of(shapes, Handle::move_x), *y = shape_of(shapes, Handle::move_y);
    ASSERT_TRUE(x && y);
    EXPECT_NEAR(x->from.x, 500, 0.1);
    EXPECT_NEAR(x->from.y, 350, 0.1);
    EXPECT_NEAR(x->grip.x, 580, 0.5);
    EXPECT_NEAR(y->grip.y, 270, 0.5);
    EXPECT_FALSE(shape_of(shapes, Handle::move_z));
    EXPECT_FALSE(shape_of(shapes, Handle::aim));
}

TEST(Handles, NoneForWhatIsBehindTheEye) {
    const Setting s;
    EXPECT_TRUE(handle_shapes(s.projection(), s.image, {0, 0, 11}, Vec3d{0, 0, 0}, 80).empty());
}

TEST(Handles, GripsWinOverLines) {
    const Setting s;
    const auto shapes = handle_shapes(s.projection(), s.image, {0, 0, 0}, Vec3d{2, 2, 0}, 80);
    EXPECT_EQ(handle_under(shapes, {500, 350}, 12), Handle::move);
    EXPECT_EQ(handle_under(shapes, {580, 350}, 12), Handle::move_x);
    EXPECT_EQ(handle_under(shapes, {545, 352}, 12), Handle::move_x);
    EXPECT_EQ(handle_under(shapes, {545, 370}, 12), Handle::none);
    const HandleShape* aim = shape_of(shapes, Handle::aim);
    ASSERT_TRUE(aim);
    EXPECT_EQ(handle_under(shapes, aim->grip, 12), Handle::aim);
}

TEST(Drag, InThePlaneOfTheScreenTheNodeFollowsTheMouse) {
    const Setting s;
    const Vec3d start{1, 1, -3};
    const auto from = s.projection().project(start);
    ASSERT_TRUE(from);
    const ScreenPoint down = s.image.at(*from), up{down.x + 120, down.y - 40};
    const Vec3d moved = dragged_position(Handle::move, s.projection(), s.ray_at(down), s.ray_at(up), start);
    const auto to = s.projection().project(moved);
    ASSERT_TRUE(to);
    EXPECT_NEAR(s.image.at(*to).x, up.x, 0.01);
    EXPECT_NEAR(s.image.at(*to).y, up.y, 0.01);
    EXPECT_NEAR(moved.z, start.z, close);
}

TEST(Drag, AlongAnAxisNothingElseMoves) {
    const Setting s;
    const Vec3d start{1, 1, -3};
    const Vec3d moved = dragged_position(Handle::move_x, s.projection(), s.ray_at({500, 300}), s.ray_at({620, 380}), start);
    EXPECT_GT(moved.x, start.x + 0.5);
    EXPECT_EQ(moved.y, start.y);
    EXPECT_EQ(moved.z, start.z);
}

TEST(Drag, GrabbedBesideTheGripItDoesNotJump) {
    const Setting s;
    const Vec3d start{1, 1, -3};
    for (const Handle h : {Handle::move, Handle::move_x, Handle::move_y})
        expect_near(dragged_position(h, s.projection(), s.ray_at({511, 333}), s.ray_at({511, 333}), start), start);
}

TEST(MeetPlane, NothingBehindOrParallel) {
    EXPECT_FALSE(meet_plane({{0, 0, 0}, {0, 0, -1}}, {0, 0, 5}, {0, 0, 1}));
    EXPECT_FALSE(meet_plane({{0, 0, 0}, {1, 0, 0}}, {0, 0, -5}, {0, 0, 1}));
    const auto p = meet_plane({{1, 2, 0}, {0, 0, -1}}, {0, 0, -5}, {0, 0, 1});
    ASSERT_TRUE(p);
    expect_near(*p, {1, 2, -5});
}

// A child under a parent that is moved, turned and scaled unevenly.
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

TEST(Place, ANodeGoesWhereItIsPutWhateverItsParent) {
    Family f;
    f.place(moved_to(f.scene, f.child, {-4, 5, 6}));
    expect_near(world_from_node(f.scene, f.child).t, {-4, 5, 6});
}

TEST(Place, ANodeLooksWhereItIsAimedWhateverItsParent) {
    Family f;
    const Vec3d origin = world_from_node(f.scene, f.child).t, direction = normalize(Vec3d{1, -2, 0.5});
    f.place(rotated_to(f.scene, f.child, looking_along(direction)));
    expect_near(world_from_node(f.scene, f.child).t, origin);
    expect_near(rotate(world_rotation(f.scene, f.child), {0, 0, -1}), direction);
}

TEST(Place, UnderAParentScaledToNothingItStays) {
    Family f;
    Node p = *f.scene.nodes.find(f.parent);
    p.local.scale = {0, 1, 1};
    f.scene.nodes.set(f.parent, p);
    EXPECT_EQ(moved_to(f.scene, f.child, {9, 9, 9}), f.scene.nodes.find(f.child)->local);
}

} // namespace
} // namespace blush
