// Light camera: view and light move together, whichever of them is moved.
#include "core/math.h"
#include "scene/affine.h"
#include "ui/lights/light_camera.h"
#include "ui/lights/light_tools.h"
#include "ui/transform/rotation.h"
#include "ui/viewport/orbit_camera.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

struct Lamp {
    Scene scene;
    Id<Node> id;

    explicit Lamp(Light::Kind kind) {
        Light light;
        light.kind = kind;
        light.radius = 0.25f;
        Node node;
        node.light = scene.lights.add(light);
        node.local.translation = {2, 3, 1};
        node.local.rotation = looking_along({-1, -1, -0.3});
        id = scene.nodes.add(node);
        scene.view.position = {0, 1, 6};
        scene.view.pivot_distance = 5;
    }
    const Light& light() const { return scene.lights.begin()->value; }
    LightPose pose() const { return pose_of(scene, id); }
    View through(const View& view) const { return view_through_light(view, light(), pose(), clearance(scene, id)); }
    View first() const { return initial_light_view(scene.view, light(), pose(), clearance(scene, id)); }
};

Vec3d forward(const Quat& q) { return rotate(q, {0, 0, -1}); }

void expect_near(const Vec3d& a, const Vec3d& b, double tolerance = 1e-5) { EXPECT_LT(length(a - b), tolerance); }

class EveryKind : public testing::TestWithParam<Light::Kind> {};
INSTANTIATE_TEST_SUITE_P(LookThrough, EveryKind,
                         testing::Values(Light::Kind::point, Light::Kind::spot, Light::Kind::sun, Light::Kind::rectangle, Light::Kind::disk,
                                         Light::Kind::sphere));

TEST_P(EveryKind, ViewMatchesTheLight) {
    const Lamp lamp(GetParam());
    const View view = lamp.first();
    if (has_direction(GetParam())) expect_near(forward(view.rotation), forward(lamp.pose().rotation));
    if (GetParam() == Light::Kind::sun) {
        expect_near(pivot(view), pivot(lamp.scene.view));
    } else {
        expect_near(to_double(view.position), lamp.pose().position + forward(view.rotation) * clearance(lamp.scene, lamp.id));
        EXPECT_NEAR(view.pivot_distance, length(pivot(lamp.scene.view) - lamp.pose().position), 1e-5);
    }
    if (!has_direction(GetParam())) expect_near(pivot(view), pivot(lamp.scene.view), 0.3); // within the size of the light
}

// Otherwise the render would restart in every frame of the window.
TEST_P(EveryKind, RepeatingItChangesNothing) {
    const Lamp lamp(GetParam());
    const View view = lamp.first();
    EXPECT_EQ(lamp.through(view), view);
}

TEST_P(EveryKind, LightFollowsTheView) {
    Lamp lamp(GetParam());
    for (const View& moved :
         {orbit(lamp.first(), 0.4, 0.2), pan(lamp.first(), 0.1, -0.2), dolly(lamp.first(), 0.7), fly(lamp.first(), {1, 2, 3})}) {
        Lamp carried = lamp;
        const LightPose pose = light_pose_of_view(moved, lamp.light(), lamp.pose(), clearance(lamp.scene, lamp.id));
        carried.scene.nodes.set(lamp.id, with_pose(lamp.scene, lamp.id, pose));
        const View seen = carried.through(moved);
        expect_near(forward(seen.rotation), forward(moved.rotation));
        expect_near(to_double(seen.position), to_double(moved.position), 1e-4);
        EXPECT_EQ(carried.through(seen), seen);
    }
}

TEST(LookThrough, ViewPositionIsOutsideTheLight) {
    for (const auto kind : {Light::Kind::sphere, Light::Kind::point}) {
        const Lamp lamp(kind);
        EXPECT_GT(length(to_double(lamp.first().position) - lamp.pose().position), 0.25);
    }
    const Lamp panel(Light::Kind::rectangle);
    EXPECT_GT(dot(to_double(panel.first().position) - panel.pose().position, forward(panel.pose().rotation)), 1e-4);
}

} // namespace
} // namespace blush::TEST_FILE
