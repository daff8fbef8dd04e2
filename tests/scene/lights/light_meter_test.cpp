// Light meters stay on their surface, and regions are whole pixels.
#include "scene/image_region.h"
#include "scene/lights/light_meter.h"

#include "core/math.h"
#include "scene/affine.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

void expect_near(const Vec3d& got, const Vec3d& wanted, double tolerance = 1e-6) {
    EXPECT_NEAR(got.x, wanted.x, tolerance);
    EXPECT_NEAR(got.y, wanted.y, tolerance);
    EXPECT_NEAR(got.z, wanted.z, tolerance);
}

// A node that is moved, turned, scaled unevenly and mirrored, below another.
struct Placed {
    Scene scene;
    Id<Node> node;
    Placed() {
        Node parent;
        parent.local.translation = {10, 0, -3};
        parent.local.scale = {2, 2, 2};
        const Id<Node> above = scene.nodes.add(parent);
        Node child;
        child.parent = above;
        child.local.rotation = {0.5f, 0.5f, 0.5f, 0.5f};
        child.local.scale = {1, 3, -0.5f};
        node = scene.nodes.add(child);
    }
};

TEST(LightMeters, KeepTheirPosition) {
    const Placed p;
    const Vec3d position{1, 2, 3}, normal = normalize(Vec3d{1, -2, 0.5});
    const PlacedMeter m = placed(p.scene, meter_on(p.scene, p.node, position, normal, ""));
    expect_near(m.position, position, 1e-5);
    expect_near(m.normal, normal, 1e-5);
}

TEST(LightMeters, MoveAndTurnWithTheirNode) {
    Placed p;
    const LightMeter meter = meter_on(p.scene, p.node, {1, 2, 3}, {0, 1, 0}, "");
    const Affined before = world_from_node(p.scene, p.node);
    Node moved = *p.scene.nodes.find(p.node);
    moved.local.translation = {0, 5, 1};
    moved.local.rotation = {0, 0, 0.70710678f, 0.70710678f};
    p.scene.nodes.set(p.node, moved);
    const Affined change = world_from_node(p.scene, p.node) * inverse(before);
    const PlacedMeter m = placed(p.scene, meter);
    expect_near(m.position, transform_point(change, Vec3d{1, 2, 3}), 1e-5);
    // The normal stays at right angles to what lay in the surface.
    for (const Vec3d& along : {Vec3d{1, 0, 0}, Vec3d{0, 0, 1}})
        EXPECT_NEAR(dot(m.normal, normalize(transform_vector(change, along))), 0, 1e-5);
    EXPECT_NEAR(length(m.normal), 1, 1e-6);
}

TEST(LightMeters, OfARemovedNodeStayInTheWorld) {
    const PlacedMeter m = placed(Scene{}, {"", {99}, {1, 2, 3}, {0, 0, 1}, 0});
    expect_near(m.position, {1, 2, 3});
    expect_near(m.normal, {0, 0, 1});
    Scene flat;
    Node node;
    node.local.scale = {1, 0, 1};
    const Id<Node> id = flat.nodes.add(node);
    EXPECT_FALSE(meter_on(flat, id, {1, 2, 3}, {0, 1, 0}, "").node) << "a flattened node has no inverse transform";
}

TEST(ImageRegions, AreWholePixels) {
    EXPECT_EQ(pixels_of({}, 640, 480), (PixelRect{0, 0, 640, 480}));
    EXPECT_EQ(pixels_of({0.25f, 0.5f, 0.5f, 0.25f}, 100, 10), (PixelRect{25, 5, 75, 8}));
    EXPECT_EQ(pixels_of({0.999f, 0.999f, 1e-6f, 1e-6f}, 100, 100), (PixelRect{99, 99, 100, 100})) << "one at least";
    // A region in pixels, as on the command line, is the same after conversion, for every image size.
    for (const int width : {1, 7, 640, 65536})
        for (const int x : {0, width / 3, width - 1}) {
            const ImageRegion r{float(x) / float(width), 0, float(width - x) / float(width), 1};
            EXPECT_EQ(pixels_of(r, width, 1), (PixelRect{x, 0, width, 1}));
        }
}

} // namespace
} // namespace blush::TEST_FILE
