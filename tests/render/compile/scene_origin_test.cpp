// The render origin: near the geometry, exact, and stable while it is good enough.
#include "render/compile/scene_origin.h"

#include "core/math.h"
#include "scene/affine.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace blush::test::TEST_FILE {
namespace {

Bounds box(const Vec3d& centre, double half) {
    Bounds b;
    b.include(centre - Vec3d{half, half, half});
    b.include(centre + Vec3d{half, half, half});
    return b;
}

TEST(RenderOrigin, IsTheWorldOriginForScenesAroundIt) {
    EXPECT_EQ(render_origin({}), (Vec3d{0, 0, 0}));
    for (const double half : {1e-6, 0.3, 1.0, 1e6}) {
        EXPECT_EQ(render_origin(box({0, 0, 0}, half)), (Vec3d{0, 0, 0}));
        EXPECT_EQ(render_origin(box({2 * half, -half, half}, half)), (Vec3d{0, 0, 0}));
    }
    Bounds point;
    point.include({5, 5, 5});
    EXPECT_EQ(render_origin(point), (Vec3d{0, 0, 0}));
}

TEST(RenderOrigin, IsWithinFourRadiiOfTheCentre) {
    for (const double half : {1e-6, 0.3, 1.0, 17.0, 1e6})
        for (const double away : {10.0, 1e3, 1e7}) {
            const Vec3d centre{away * half, -0.7 * away * half, 0};
            const Vec3d origin = render_origin(box(centre, half));
            EXPECT_NE(origin, (Vec3d{0, 0, 0}));
            const Vec3d left = centre - origin;
            EXPECT_LE(std::max({std::abs(left.x), std::abs(left.y), std::abs(left.z)}), 4 * box(centre, half).radius());
        }
}

// A drag by less than the scene's size changes the origin at most once.
TEST(RenderOrigin, StaysWhileAnObjectIsDragged) {
    int changes = 0;
    Vec3d last = render_origin(box({1000, 0, 0}, 1));
    for (int step = 0; step < 100; ++step) {
        const Vec3d origin = render_origin(box({1000 + 0.02 * step, 0, 0}, 1));
        changes += origin != last;
        last = origin;
    }
    EXPECT_LE(changes, 1);
}

TEST(SceneOrigin, IsThatOfTheTransformedVertices) {
    Scene scene;
    place(scene, cube(false), lambert(1), at({100, 0, 0}, 2));
    place(scene, cube(false), lambert(1), at({110, 5, 0}));
    ExtentCache cache;
    const std::vector<SceneObject> objects = list_objects(scene);
    for (int i = 0; i < 2; ++i) { // the second time from the cache
        const Extent extent = cache.extent_of(objects, {});
        EXPECT_EQ(extent.bounds.low, (Vec3d{98, -2, -2}));
        EXPECT_EQ(extent.bounds.high, (Vec3d{111, 6, 2}));
        EXPECT_EQ(extent.origin, render_origin(extent.bounds));
    }
}

// Tables relative to the origin are the same if the scene is moved by a multiple of the origin's steps: so is the image.
TEST(SceneOrigin, AFarSceneRendersLikeTheNearOneBitForBit) {
    const auto still_life = [](const Vec3& away) {
        Scene scene;
        place(scene, floor_quad(2), lambert(0.7f), at(away));
        place(scene, sphere(false), glass(0, 1.5f), at(away + Vec3{-0.5f, 0.5f, 0}, 0.5f));
        place(scene, cube(false), metal(0.4f), at(away + Vec3{0.75f, 0.25f, 0.5f}, 0.25f));
        Light lamp;
        lamp.kind = Light::Kind::rectangle;
        place_light(scene, lamp, aimed(away + Vec3{0, 2, 0}, {0, -1, 0}));
        place_light(scene, Light{}, at(away + Vec3{1, 1, 1}));
        constant_world(scene, 0.1f);
        scene.view = looking({0, 2, 4}, {0, 0.25f, 0}, 0.8f);
        scene.view.position = scene.view.position + away;
        return scene;
    };
    const PlaneSet planes{true, true, true, true};
    const Frame near = render(still_life({0, 0, 0}), settings_for(24, 24, 8), planes).frame;
    // Limited to distances where nodes and camera are still exact to a quarter of a metre.
    for (const Vec3& away : {Vec3{1024, 0, -2048}, Vec3{0x1p20f, 0x1p21f, 0}}) {
        const Frame far = render(still_life(away), settings_for(24, 24, 8), planes).frame;
        EXPECT_EQ(far.rgba, near.rgba) << away.x;
        EXPECT_EQ(far.normal, near.normal);
        EXPECT_EQ(far.depth, near.depth);
        EXPECT_EQ(far.object_id, near.object_id);
    }
}

TEST(PathLog, PrintsWorldCoordinates) {
    Scene scene;
    place(scene, floor_quad(1, 0), lambert(0.5f), at({1e7f, 16, -3e6f}));
    scene.view = looking_down(1, 1);
    scene.view.position = {1e7f, 20, -3e6f};
    const std::string log = trace_sample(scene, settings_for(1, 1, 1), 0, 0, 0);
    const size_t at = log.find("position   (");
    ASSERT_NE(at, std::string::npos) << log;
    Vec3d p;
    ASSERT_EQ(std::sscanf(log.c_str() + at, "position   (%lf, %lf, %lf)", &p.x, &p.y, &p.z), 3) << log;
    EXPECT_NEAR(p.x, 1e7, 1.01);
    EXPECT_EQ(p.y, 16);
    EXPECT_NEAR(p.z, -3e6, 1.01);
}

} // namespace
} // namespace blush::test::TEST_FILE
