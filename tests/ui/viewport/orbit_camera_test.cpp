// Projection and camera navigation, against analytic results and against each other.
#include "ui/transform/rotation.h"
#include "ui/viewport/orbit_camera.h"
#include "ui/viewport/projection.h"

#include <gtest/gtest.h>

#include <numbers>

namespace blush::TEST_FILE {
namespace {

constexpr double close = 1e-5; // positions are floats of order one

void expect_near(const Vec3d& a, const Vec3d& b, double tolerance = close) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

// At (1, 2, 5), looking along -Z, 90 degrees high.
View sample_view() {
    View view;
    view.position = {1, 2, 5};
    view.pivot_distance = 4;
    view.lens.yfov_radians = std::numbers::pi_v<float> / 2;
    return view;
}

TEST(Projection, CentreOfTheImageIsOnTheViewAxis) {
    const Projection p(sample_view(), 1.5);
    const auto point = p.project({1, 2, 0});
    ASSERT_TRUE(point);
    EXPECT_NEAR(point->u, 0.5, close);
    EXPECT_NEAR(point->v, 0.5, close);
    EXPECT_NEAR(point->distance, 5, close);
}

TEST(Projection, CornersOfA90DegreeViewHaveTangentOne) {
    const Projection p(sample_view(), 2);
    const auto top_right = p.project({1 + 2 * 3, 2 + 3, 2}); // three metres ahead
    ASSERT_TRUE(top_right);
    EXPECT_NEAR(top_right->u, 1, close);
    EXPECT_NEAR(top_right->v, 0, close);
    EXPECT_NEAR(p.height_at(3), 6, close);
}

TEST(Projection, PointBehindTheCameraHasNoProjection) { EXPECT_FALSE(Projection(sample_view(), 1).project({1, 2, 6})); }

TEST(Projection, RayPassesThroughTheProjectedPoint) {
    for (const bool orthographic : {false, true}) {
        View view = sample_view();
        view.lens.orthographic = orthographic;
        view.lens.ymag = 3;
        view.rotation = looking_along({1, -0.4, -2});
        const Projection p(view, 1.7);
        for (const double u : {0.1, 0.5, 0.93}) {
            for (const double v : {0.02, 0.6}) {
                const ViewRay ray = p.ray(u, v);
                EXPECT_NEAR(length(ray.direction), 1, 1e-12);
                const auto back = p.project(ray.origin + ray.direction * 7.0);
                ASSERT_TRUE(back);
                EXPECT_NEAR(back->u, u, close);
                EXPECT_NEAR(back->v, v, close);
                EXPECT_NEAR(back->distance, p.axial_distance(u, v, 7), close);
            }
        }
    }
}

TEST(Orbit, KeepsPivotAndDistance) {
    const View view = sample_view();
    const View turned = orbit(view, 0.7, 0.3);
    expect_near(pivot(turned), pivot(view));
    EXPECT_FLOAT_EQ(turned.pivot_distance, view.pivot_distance);
    EXPECT_GT(turned.position.x, view.position.x) << "positive yaw carries the eye to its right";
    EXPECT_GT(turned.position.y, view.position.y) << "positive pitch carries the eye up";
}

TEST(Orbit, IsClampedAtThePolesAndStaysUpright) {
    View view = sample_view();
    for (int i = 0; i < 50; ++i) view = orbit(view, 0.1, 0.2);
    expect_near(pivot(view), pivot(sample_view()), 1e-3);
    const Vec3d up = rotate(view.rotation, {0, 1, 0}), forward = rotate(view.rotation, {0, 0, -1});
    EXPECT_GT(up.y, 0);
    EXPECT_LT(forward.y, -0.99);
    EXPECT_NEAR(rotate(view.rotation, {1, 0, 0}).y, 0, 1e-4) << "the horizon stays level";
    for (int i = 0; i < 50; ++i) view = orbit(view, 0, -0.2);
    EXPECT_GT(rotate(view.rotation, {0, 0, -1}).y, 0.99);
}

TEST(LookAround, RotatesAboutTheCameraPosition) {
    const View view = sample_view(), turned = look_around(view, 0.5, 0.2);
    EXPECT_EQ(turned.position, view.position);
    const Vec3d forward = rotate(turned.rotation, {0, 0, -1});
    EXPECT_LT(forward.x, 0) << "positive yaw looks left";
    EXPECT_GT(forward.y, 0) << "positive pitch looks up";
}

TEST(Pan, ThePivotFollowsTheMouse) {
    for (const bool orthographic : {false, true}) {
        View view = sample_view();
        view.lens.orthographic = orthographic;
        view.lens.ymag = 2;
        const auto moved = Projection(pan(view, 0.2, -0.1), 1).project(pivot(view));
        ASSERT_TRUE(moved);
        EXPECT_NEAR(moved->u, 0.5 + 0.2, close);
        EXPECT_NEAR(moved->v, 0.5 - 0.1, close);
    }
}

TEST(Dolly, ScalesTheDistanceToThePivotOrTheOrthographicSize) {
    const View view = sample_view(), closer = dolly(view, 0.5);
    expect_near(pivot(closer), pivot(view));
    EXPECT_FLOAT_EQ(closer.pivot_distance, 2);
    View flat = view;
    flat.lens.orthographic = true;
    EXPECT_FLOAT_EQ(dolly(flat, 0.5).lens.ymag, flat.lens.ymag / 2);
    EXPECT_EQ(dolly(flat, 0.5).position, flat.position);
}

TEST(Dolly, NeverReachesThePivot) {
    View view = sample_view();
    for (int i = 0; i < 2000; ++i) view = dolly(view, 0.5);
    EXPECT_GT(view.pivot_distance, 0);
    for (int i = 0; i < 2000; ++i) view = dolly(view, 2);
    EXPECT_TRUE(std::isfinite(view.position.z));
}

TEST(Fly, MovesAlongTheViewsAxes) {
    const View view = sample_view();
    expect_near(to_double(fly(view, {1, 2, 3}).position), {2, 4, 2});
}

TEST(Rotation, EulerAnglesRoundTrip) {
    for (const Vec3d& degrees : {Vec3d{10, 20, 30}, Vec3d{-170, 45, 5}, Vec3d{0, 90, 0}, Vec3d{25, -90, 0}}) {
        const Quat q = from_euler_degrees(degrees), again = from_euler_degrees(euler_degrees(q));
        const double same = std::abs(q.x * again.x + q.y * again.y + q.z * again.z + q.w * again.w);
        EXPECT_NEAR(same, 1, 1e-5) << degrees.x << ' ' << degrees.y << ' ' << degrees.z;
    }
}

TEST(Rotation, LookingAlongAnyDirection) {
    for (const Vec3d& d : {Vec3d{0, 0, -1}, Vec3d{0, 1, 0}, Vec3d{0, -1, 0}, Vec3d{1, 2, 3}, Vec3d{0, 0, 1}}) {
        const Quat q = looking_along(d);
        expect_near(rotate(q, {0, 0, -1}), normalize(d));
        EXPECT_NEAR(rotate(q, {1, 0, 0}).y, 0, close) << "level";
    }
}

} // namespace
} // namespace blush::TEST_FILE
