// Modal transforms (G, R, S): input handling, and the resulting edits of nodes and lights.
#include "scene/document/document.h"
#include "ui/transform/rotation.h"
#include "ui/transform/transform_edits.h"

#include <gtest/gtest.h>
#include <numbers>

namespace blush::TEST_FILE {
namespace {

constexpr double close = 1e-5;
constexpr double degree = std::numbers::pi / 180;
using Answer = TransformTool::Answer;

void expect_near(const Vec3d& a, const Vec3d& b, double within = close) {
    EXPECT_NEAR(a.x, b.x, within);
    EXPECT_NEAR(a.y, b.y, within);
    EXPECT_NEAR(a.z, b.z, within);
}

// Seen from +Z; the pivot is at the centre of an image of 800 x 600, where 1 m is about 55 pixels.
struct Bench {
    View view;
    ImageRect image{0, 0, 800, 600};
    Bench() {
        view.position = {0, 0, 10};
        view.lens.yfov_radians = 1;
    }
    TransformTool tool(TransformMode mode, ScreenPoint mouse = {500, 300}) const {
        const Quat q = axis_angle({0, 0, 1}, 30 * degree);
        return TransformTool({.mode = mode,
                              .pivot = {0, 0, 0},
                              .local_axes = {rotate(q, {1, 0, 0}), rotate(q, {0, 1, 0}), {0, 0, 1}},
                              .projection = Projection(view, 800.0 / 600.0),
                              .image = image,
                              .mouse = mouse});
    }
};

// The key presses for each character; capitals with Shift.
void type(TransformTool& tool, const std::string& text) {
    for (const char c : text)
        EXPECT_EQ(tool.press({.key = std::toupper(c), .shift = std::isupper(c) != 0, .typed = char32_t(c)}), Answer::taken) << c;
}

TEST(Grab, FollowsTheMouseInThePlaneOfTheScreen) {
    TransformTool tool = Bench().tool(TransformMode::grab);
    tool.point_at({600, 240}, false, false);
    const Vec3d by = tool.motion().by;
    const auto seen = Projection(Bench().view, 800.0 / 600.0).project(by);
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->u * 800 - 400, 100, 0.01);
    EXPECT_NEAR(seen->v * 600 - 300, -60, 0.01);
    EXPECT_NEAR(by.z, 0, close);
}

TEST(Grab, AxisKeyCyclesWorldLocalFree) {
    TransformTool tool = Bench().tool(TransformMode::grab);
    tool.point_at({600, 240}, false, false);
    type(tool, "x");
    const Vec3d world = tool.motion().by;
    EXPECT_GT(world.x, 0.5);
    EXPECT_EQ(world.y, 0);
    type(tool, "x");
    const Vec3d local = tool.motion().by;
    EXPECT_NEAR(std::atan2(local.y, local.x), 30 * degree, close);
    EXPECT_NE(tool.text().find("along X (local)"), std::string::npos) << tool.text();
    type(tool, "x");
    EXPECT_GT(tool.motion().by.y, 0.5) << "free again";
}

TEST(Grab, ShiftAndAxisLocksToThePlane) {
    TransformTool tool = Bench().tool(TransformMode::grab);
    type(tool, "X2");
    expect_near(tool.motion().by, {0, 2, 0});
    tool.press({.key = key::tab});
    type(tool, "3");
    expect_near(tool.motion().by, {0, 2, 3});
    EXPECT_NE(tool.text().find("in YZ"), std::string::npos) << tool.text();
}

TEST(Typing, SetsTheAmountWithMinusPointAndBackspace) {
    TransformTool tool = Bench().tool(TransformMode::grab);
    tool.point_at({700, 100}, false, false);
    type(tool, "y12.5");
    expect_near(tool.motion().by, {0, 12.5, 0});
    type(tool, "-");
    expect_near(tool.motion().by, {0, -12.5, 0});
    EXPECT_NE(tool.text().find("-12.5|"), std::string::npos) << tool.text();
    tool.press({.key = key::backspace});
    expect_near(tool.motion().by, {0, -12, 0});
    type(tool, ".5.5"); // a second decimal point is ignored
    expect_near(tool.motion().by, {0, -12.55, 0});
    for (int i = 0; i < 10; ++i) tool.press({.key = key::backspace});
    EXPECT_NE(tool.motion().by.y, 0) << "the mouse again";
    for (int i = 0; i < 400; ++i) type(tool, "9");
    EXPECT_LE(tool.motion().by.y, 1e9);
}

TEST(Typing, AcceptsTheNumberPad) {
    TransformTool tool = Bench().tool(TransformMode::grab);
    for (const int code : {key::pad_zero + 4, key::pad_point, key::pad_zero + 2, key::pad_minus}) tool.press({.key = code});
    expect_near(tool.motion().by, {-4.2, 0, 0});
    EXPECT_EQ(tool.press({.key = key::pad_enter}), Answer::confirmed);
}

TEST(Trackball, IsTheSecondR) {
    TransformTool tool = Bench().tool(TransformMode::rotate);
    EXPECT_FALSE(tool.is_trackball());
    type(tool, "r");
    EXPECT_TRUE(tool.is_trackball());
    type(tool, "r");
    EXPECT_FALSE(tool.is_trackball()) << "the third R is a plain rotation again";
    type(tool, "gr");
    EXPECT_FALSE(tool.is_trackball()) << "R from another mode";
}

// The view looks along -Z: what faces the viewer is at +Z.
TEST(Trackball, SurfaceFollowsTheMouse) {
    TransformTool tool = Bench().tool(TransformMode::rotate);
    type(tool, "r");
    tool.point_at({550, 300}, false, false); // 50 pixels to the right
    EXPECT_NEAR(tool.motion().radians, 0.5, close);
    expect_near(tool.motion().direction({0, 0, 1}), {std::sin(0.5), 0, std::cos(0.5)});
    tool.point_at({500, 270}, false, false); // 30 pixels up
    expect_near(tool.motion().direction({0, 0, 1}), {0, std::sin(0.3), std::cos(0.3)});
    tool.point_at({530, 260}, false, false);
    EXPECT_NEAR(tool.motion().radians, 0.5, close) << "both at once: 0.3 and 0.4";
    EXPECT_GT(tool.motion().direction({0, 0, 1}).x, 0.2);
    EXPECT_GT(tool.motion().direction({0, 0, 1}).y, 0.3);
}

TEST(Trackball, SnapsTypesAndHasNoAxes) {
    TransformTool tool = Bench().tool(TransformMode::rotate);
    type(tool, "r");
    tool.point_at({511, 300}, false, true); // 6.3 degrees
    EXPECT_NEAR(tool.motion().radians, 5 * degree, close);
    type(tool, "x");
    EXPECT_EQ(tool.lock(), AxisLock{});
    tool.press({.key = key::tab});
    type(tool, "90");
    expect_near(tool.motion().direction({0, 0, 1}), {1, 0, 0});
    EXPECT_NE(tool.text().find("trackball"), std::string::npos) << tool.text();
    EXPECT_NE(tool.text().find("right 90|"), std::string::npos) << tool.text();
}

TEST(Keys, ConfirmCancelAndSwitchModes) {
    TransformTool tool = Bench().tool(TransformMode::grab);
    EXPECT_EQ(tool.press({.key = key::escape}), Answer::cancelled);
    EXPECT_EQ(tool.press({.key = key::enter}), Answer::confirmed);
    EXPECT_EQ(tool.press({.key = 'Q', .typed = 'q'}), Answer::ignored);
    type(tool, "y3");
    type(tool, "r");
    EXPECT_EQ(tool.mode(), TransformMode::rotate);
    EXPECT_EQ(tool.lock(), AxisLock{});
    type(tool, "90");
    EXPECT_NEAR(tool.motion().radians, 90 * degree, close);
}

TEST(Keys, UseTheKeyboardLayout) {
    TransformTool tool = Bench().tool(TransformMode::grab);
    tool.press({.key = 'Y', .typed = 'z'}); // on a German keyboard
    EXPECT_EQ(tool.lock().axis, 2);
}

TEST(Mouse, ShiftMovesFinelyAndCtrlSnaps) {
    TransformTool tool = Bench().tool(TransformMode::grab);
    type(tool, "x");
    tool.point_at({600, 300}, false, false);
    const double full = tool.motion().by.x;
    tool.point_at({700, 300}, true, false);
    EXPECT_NEAR(tool.motion().by.x, full * 1.1, 1e-3);
    tool.point_at({700, 300}, false, true);
    EXPECT_NEAR(tool.motion().by.x, std::round(full * 1.1), close) << "whole metres in a view of eleven";
}

TEST(Rotate, TurnsCounterClockwiseWithTheMouse) {
    TransformTool tool = Bench().tool(TransformMode::rotate); // right of the pivot
    tool.point_at({400, 200}, false, false);                  // above it
    const Motion m = tool.motion();
    expect_near(m.direction({1, 0, 0}), {0, 1, 0});
    tool.point_at({300, 300}, false, false);
    tool.point_at({400, 400}, false, false);
    tool.point_at({500, 300}, false, false);
    EXPECT_NEAR(tool.motion().radians, 360 * degree, 1e-4) << "full turns count";
    tool.point_at({500, 293}, false, true);
    EXPECT_NEAR(tool.motion().radians, 365 * degree, 1e-4);
}

TEST(Rotate, AboutAnAxisPointingAwayFollowsTheMouse) {
    Bench bench;
    bench.view.position = {0, 0, -10};
    bench.view.rotation = looking_along({0, 0, 1});
    TransformTool tool = bench.tool(TransformMode::rotate);
    type(tool, "z");
    tool.point_at({400, 200}, false, false); // counter-clockwise, seen from behind
    EXPECT_NEAR(tool.motion().radians, -90 * degree, 1e-4);
    type(tool, "90");
    expect_near(tool.motion().direction({1, 0, 0}), {0, 1, 0}); // typed: right-handed about +Z
}

TEST(Scale, ByTheDistanceToThePivot) {
    TransformTool tool = Bench().tool(TransformMode::scale);
    tool.point_at({600, 300}, false, false);
    expect_near(tool.motion().factors, {2, 2, 2});
    tool.point_at({350, 300}, false, false);
    expect_near(tool.motion().factors, {-0.5, -0.5, -0.5});
    type(tool, "Z3");
    expect_near(tool.motion().factors, {3, 3, 1});
    type(tool, "z");
    expect_near(tool.motion().factors, {1, 1, 3});
}

struct Stage {
    Project project;
    Id<Node> add(const Node& node) { return project.scene.nodes.add(node); }
    Id<Node> add(const Light& light, const Node& node = {}) {
        Node n = node;
        n.light = project.scene.lights.add(light);
        return add(n);
    }
    std::vector<TransformTarget> targets(std::vector<Id<Node>> ids) const { return transform_targets(project.scene, ids); }
    void apply(const std::vector<Id<Node>>& ids, const Motion& motion) {
        for (const Edit& edit : transform_edits(project.scene, targets(ids), motion)) {
            auto next = blush::apply(project, edit);
            ASSERT_TRUE(next) << next.error().text();
            project = *std::move(next);
        }
    }
    Affined world(Id<Node> id) const { return world_from_node(project.scene, id); }
    const Light& light(Id<Node> id) const { return *project.scene.lights.find(project.scene.nodes.find(id)->light); }
};

Node placed(const Vec3& at, const Vec3d& degrees = {0, 0, 0}) {
    Node node;
    node.local.translation = at;
    node.local.rotation = from_euler_degrees(degrees);
    return node;
}

TEST(Edits, ChildOfARotatedParentMovesInWorldSpace) {
    Stage s;
    Node parent = placed({1, 2, 3}, {20, 130, -40});
    parent.local.scale = {2, 0.5f, 3};
    const Id<Node> above = s.add(parent);
    Node child = placed({0.5f, 0, -1});
    child.parent = above;
    const Id<Node> id = s.add(child);
    const Vec3d before = s.world(id).t;
    s.apply({id}, {.by = {1, -2, 0.5}});
    expect_near(s.world(id).t, before + Vec3d{1, -2, 0.5});
    s.apply({above, id}, {.by = {1, 0, 0}}); // the child moves with its parent, not twice
    expect_near(s.world(id).t, before + Vec3d{2, -2, 0.5});
}

TEST(Edits, RotationIsAboutThePivot) {
    Stage s;
    const Id<Node> a = s.add(placed({1, 0, 0})), b = s.add(placed({3, 0, 0}, {0, 90, 0}));
    s.apply({a, b}, {.mode = TransformMode::rotate, .pivot = {2, 0, 0}, .axis = {0, 0, 1}, .radians = 90 * degree});
    expect_near(s.world(a).t, {2, -1, 0});
    expect_near(s.world(a).x, {0, 1, 0});
    expect_near(s.world(b).t, {2, 1, 0});
    expect_near(s.world(b).x, {0, 0, -1}); // -Z: the axis of the turn
}

TEST(Edits, ScaleStretchesLocalAxesWithoutShear) {
    Stage s;
    const Id<Node> a = s.add(placed({1, 0, 0}, {0, 0, 90})), b = s.add(placed({1, 0, 0}, {0, 0, 45}));
    const Motion wide{.mode = TransformMode::scale, .factors = {3, 1, 1}};
    s.apply({a}, wide);
    expect_near(s.world(a).t, {3, 0, 0});
    EXPECT_NEAR(length(s.world(a).y), 3, close);
    EXPECT_NEAR(length(s.world(a).x), 1, close);
    s.apply({b}, wide);
    EXPECT_FALSE(s.project.scene.nodes.find(b)->local.matrix);
    EXPECT_NEAR(dot(s.world(b).x, s.world(b).y), 0, close);
    s.apply({a}, {.mode = TransformMode::scale, .factors = {0, 1, 1}}); // flat
    EXPECT_NEAR(length(s.world(a).y), 0, close);
}

TEST(Edits, LightsOfAllTypesScaleInSize) {
    using Kind = Light::Kind;
    for (const Kind kind : {Kind::point, Kind::spot, Kind::sun, Kind::rectangle, Kind::disk, Kind::sphere}) {
        Stage s;
        Light before{.kind = kind, .radius = 0.5f, .angle_radians = 0.01f, .width = 2, .height = 1};
        const Id<Node> id = s.add(before, placed({1, 2, 3}, {0, 0, 90}));
        s.apply({id}, {.mode = TransformMode::scale, .pivot = {1, 2, 3}, .factors = {2, 2, 2}});
        const Light& light = s.light(id);
        EXPECT_EQ(s.project.scene.nodes.find(id)->local.scale, (Vec3{1, 1, 1}));
        EXPECT_NEAR(light.radius, kind == Kind::sun || kind == Kind::rectangle ? 0.5f : 1.f, 1e-5);
        EXPECT_NEAR(light.angle_radians, kind == Kind::sun ? 0.02f : 0.01f, 1e-5);
        EXPECT_NEAR(light.width, kind == Kind::rectangle ? 4 : 2, 1e-5);
        // Only along the world's X, which is the light's own Y, because it is rotated.
        s.apply({id}, {.mode = TransformMode::scale, .pivot = {1, 2, 3}, .factors = {3, 1, 1}});
        if (kind == Kind::rectangle) {
            EXPECT_NEAR(s.light(id).width, 4, 1e-5);
            EXPECT_NEAR(s.light(id).height, 6, 1e-5);
        }
    }
}

TEST(Edits, SharedLightIsScaledOnce) {
    Stage s;
    const Id<Node> a = s.add(Light{.kind = Light::Kind::sphere, .radius = 1});
    Node twin = placed({5, 0, 0});
    twin.light = s.project.scene.nodes.find(a)->light;
    const Id<Node> b = s.add(twin);
    s.apply({a, b}, {.mode = TransformMode::scale, .factors = {2, 2, 2}});
    EXPECT_NEAR(s.light(a).radius, 2, 1e-5);
    expect_near(s.world(b).t, {10, 0, 0});
}

TEST(Targets, RefusalHasAReason) {
    Stage s;
    const Id<Node> point = s.add(Light{.name = "Bulb", .kind = Light::Kind::point}), spot = s.add(Light{.kind = Light::Kind::spot});
    const Scene& scene = s.project.scene;
    EXPECT_EQ(why_not(scene, s.targets({point}), TransformMode::grab), "");
    EXPECT_NE(why_not(scene, s.targets({point}), TransformMode::rotate).find("Bulb"), std::string::npos);
    EXPECT_NE(why_not(scene, s.targets({point}), TransformMode::scale), "");
    EXPECT_EQ(why_not(scene, s.targets({spot}), TransformMode::rotate), "");
    EXPECT_EQ(why_not(scene, s.targets({point, spot}), TransformMode::rotate), "") << "their places turn";
    EXPECT_NE(why_not(scene, {}, TransformMode::grab), "");
}

TEST(Withdraw, RevertsOnlyTheStepOfItsGesture) {
    Stage s;
    const Id<Node> id = s.add(placed({1, 0, 0}));
    Document document(s.project);
    const auto move = [&](float x, Gesture gesture) { ASSERT_TRUE(document.apply(SetNode{id, placed({x, 0, 0})}, gesture)); };
    move(2, 1);
    move(3, 2);
    document.withdraw(1);
    EXPECT_EQ(document.project().scene.nodes.find(id)->local.translation.x, 3);
    document.withdraw(2);
    document.withdraw(2);
    EXPECT_EQ(document.project().scene.nodes.find(id)->local.translation.x, 2);
    EXPECT_FALSE(document.can_redo());
    EXPECT_TRUE(document.can_undo());
}

} // namespace
} // namespace blush::TEST_FILE
