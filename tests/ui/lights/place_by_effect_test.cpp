// Placing lights by highlight and by shadow.
#include "core/math.h"
#include "scene/affine.h"
#include "ui/lights/light_tools.h"
#include "ui/lights/place_by_effect.h"
#include "ui/transform/rotation.h"
#include "ui/viewport/environment_dial.h"

#include <gtest/gtest.h>

#include <random>

namespace blush::TEST_FILE {
namespace {

constexpr double close = 1e-5;

Light of_kind(Light::Kind kind) {
    Light light;
    light.kind = kind;
    light.radius = 0.1f;
    return light;
}
constexpr Light::Kind all_kinds[] = {Light::Kind::point,     Light::Kind::spot, Light::Kind::sun,
                                     Light::Kind::rectangle, Light::Kind::disk, Light::Kind::sphere};

struct Random {
    std::mt19937 engine{7};
    double number() { return std::uniform_real_distribution<double>(-1, 1)(engine); }
    Vec3d vector() { return {number(), number(), number()}; }
    Vec3d direction() { return normalize(vector()); }
    LightPose pose() { return {vector() * 5.0, looking_along(direction())}; }
};

Vec3d forward_of(const LightPose& pose) { return rotate(pose.rotation, {0, 0, -1}); }
Vec3d mirrored(const Vec3d& direction, const Vec3d& normal) { return direction - normal * (2 * dot(direction, normal)); }

// Distance of a point to a ray.
double miss(const Vec3d& origin, const Vec3d& direction, const Vec3d& point) {
    const Vec3d to = point - origin;
    return dot(to, direction) > 0 ? length(to - direction * dot(to, direction)) : 1e9;
}

TEST(PlacingByHighlight, MirroredRayHitsTheLight) {
    Random random;
    for (const auto kind : all_kinds)
        for (int i = 0; i < 100; ++i) {
            const Light light = of_kind(kind);
            const LightPose before = random.pose();
            const SurfacePoint spot{random.vector() * 3.0, random.direction(), {}};
            Vec3d view = random.direction();
            if (dot(view, spot.normal) > 0) view = -view; // seen from in front
            const double distance = length(before.position - spot.position);
            const LightPose after = with_highlight_at(light, before, spot, view, distance);
            EXPECT_LT(miss(spot.position, mirrored(view, spot.normal), after.position), close);
            EXPECT_NEAR(length(after.position - spot.position), distance, close) << "the distance is kept";
            EXPECT_TRUE(faces(spot, after.position));
            if (has_direction(kind)) {
                EXPECT_LT(miss(after.position, forward_of(after), spot.position), close * (1 + distance)) << "it emits towards the spot";
            } else {
                EXPECT_EQ(after.rotation, before.rotation);
            }
        }
}

TEST(PlacingByHighlight, NormalOfABackFaceIsFlipped) {
    const SurfacePoint spot{{0, 0, 0}, {0, -1, 0}, {}};
    const LightPose after = with_highlight_at(of_kind(Light::Kind::point), {{0, 3, 0}, {}}, spot, normalize(Vec3d{1, -1, 0}), 2);
    EXPECT_NEAR(length(after.position - normalize(Vec3d{1, 1, 0}) * 2.0), 0, close);
}

TEST(PlacingByShadow, ShadowRayPassesTheOccluder) {
    Random random;
    for (const auto kind : all_kinds)
        for (int i = 0; i < 100; ++i) {
            const Light light = of_kind(kind);
            const LightPose before = random.pose();
            const Vec3d occluder = random.vector(), target = random.vector() * 3.0;
            const double distance = length(before.position - occluder);
            const LightPose after = with_shadow_at(light, before, occluder, target, distance);
            EXPECT_LT(miss(target, normalize(after.position - target), occluder), close);
            EXPECT_GT(length(after.position - target), length(occluder - target)) << "the occluder is between the two";
            EXPECT_NEAR(length(after.position - occluder), distance, close) << "the distance is kept";
            if (has_direction(kind)) { EXPECT_LT(miss(after.position, forward_of(after), target), close * (1 + distance)); }
        }
}

// A sun has no position: its direction alone must cast the shadow.
TEST(PlacingByShadow, DirectionOfASunCastsTheShadow) {
    const Vec3d occluder{0, 1, 0}, target{2, 0, 1};
    const LightPose after = with_shadow_at(of_kind(Light::Kind::sun), {}, occluder, target, 4);
    EXPECT_LT(miss(occluder, forward_of(after), target), close);
}

TEST(PlacingByShadow, TargetOnTheOccluderHasNoEffect) {
    const LightPose before{{1, 2, 3}, {}};
    EXPECT_EQ(with_shadow_at(of_kind(Light::Kind::spot), before, {4, 5, 6}, {4, 5, 6}, 1).position, before.position);
}

TEST(WithPose, PlacesTheNodeUnderARotatedAndScaledParent) {
    Scene scene;
    Node parent;
    parent.local.translation = {1, 2, 3};
    parent.local.rotation = from_euler_degrees({20, 30, 40});
    parent.local.scale = {2, 2, 2};
    Node child;
    child.parent = scene.nodes.add(parent);
    child.local.scale = {1, 3, 1};
    const Id<Node> id = scene.nodes.add(child);
    const LightPose wanted{{-4, 5, 6}, looking_along({1, -2, 0.5})};
    scene.nodes.set(id, with_pose(scene, id, wanted));
    const LightPose pose = pose_of(scene, id);
    EXPECT_NEAR(length(pose.position - wanted.position), 0, close);
    EXPECT_NEAR(length(forward_of(pose) - forward_of(wanted)), 0, close);
    EXPECT_NEAR(scene.nodes.find(id)->local.scale.y, 3, 1e-4);
}

// Top view; the view direction is up.
TEST(EnvironmentDial, ShowsDirectionsFromAbove) {
    const auto expect_at = [](const Vec3d& direction, const Vec3d& forward, float x, float y) {
        const ScreenPoint p = dial_point(direction, forward);
        EXPECT_NEAR(p.x, x, close);
        EXPECT_NEAR(p.y, y, close);
    };
    expect_at({0, 0, -1}, {0, 0, -1}, 0, -1);
    expect_at({1, 0, 0}, {0, 0, -1}, 1, 0);
    expect_at({0, 0, -1}, {1, 0, 0}, -1, 0);
    expect_at({0, 1, 0}, {0.3, -1, 0.2}, 0, 0);
    expect_at(normalize(Vec3d{1, 1, 0}), {0, 0, -1}, 0.5f, 0);
    expect_at({1, -1, 0}, {0, 0, -1}, 1, 0);
}

} // namespace
} // namespace blush::TEST_FILE
