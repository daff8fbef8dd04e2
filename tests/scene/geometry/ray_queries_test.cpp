// Occlusion queries between two points.
#include "scene/geometry/ray_queries.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

// Squares across the x axis, 2 m wide, each on a node of its own.
struct Screens {
    Scene scene;
    Id<Mesh> square;

    Screens() {
        Geometry g;
        g.positions = {{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}};
        g.indices = {0, 1, 2, 0, 2, 3};
        square = scene.meshes.add({"Square", {{std::make_shared<const Geometry>(g), {}}}});
    }
    Id<Node> put(float x, float scale = 1, Id<Node> parent = {}) {
        Node node;
        node.mesh = square;
        node.parent = parent;
        node.local.translation = {x, 0, 0};
        node.local.scale = {scale, scale, scale};
        return scene.nodes.add(node);
    }
    std::optional<Id<Node>> between(const Vec3d& from, const Vec3d& to, Id<Node> but = {}) const {
        return first_occluder(scene, from, to, [&](Id<Node> id) { return id != but; });
    }
};

TEST(LineOfSight, FindsTheFirstOccluderFromEitherSide) {
    Screens s;
    const Id<Node> far = s.put(3), near = s.put(1);
    EXPECT_EQ(s.between({0, 0.2, 0.1}, {5, 0.2, 0.1}), near);
    EXPECT_EQ(s.between({5, 0.2, 0.1}, {0, 0.2, 0.1}), far);
    EXPECT_EQ(s.between({0, 0.2, 0.1}, {5, 0.2, 0.1}, near), far);
    EXPECT_FALSE(s.between({1.5, 0.2, 0.1}, {2.5, 0.2, 0.1})) << "both lie beyond the ends";
    EXPECT_FALSE(s.between({0, 1.2, 0}, {5, 1.2, 0})) << "past the edge";
}

TEST(LineOfSight, EndPointSurfacesDoNotOcclude) {
    Screens s;
    s.put(0);
    s.put(5);
    EXPECT_FALSE(s.between({0, 0, 0}, {5, 0, 0}));
}

TEST(LineOfSight, ParentsScaleAndHidingCount) {
    Screens s;
    Node group;
    group.local.translation = {10, 0, 0};
    const Id<Node> parent = s.scene.nodes.add(group), small = s.put(1, 0.1f, parent);
    EXPECT_EQ(s.between({8, 0.05, 0}, {12, 0.05, 0}), small);
    EXPECT_FALSE(s.between({8, 0.2, 0}, {12, 0.2, 0}));
    group.visible = false;
    s.scene.nodes.set(parent, group);
    EXPECT_FALSE(s.between({8, 0.05, 0}, {12, 0.05, 0})) << "hidden";
}

TEST(LineOfSight, DegenerateGeometryDoesNotOcclude) {
    Screens s;
    s.put(1, 0);
    EXPECT_FALSE(s.between({0, 0, 0}, {5, 0, 0}));
}

TEST(LineOfSight, TransmissionAndAlphaDoNotOcclude) {
    Screens s;
    s.put(1);
    Material paint;
    Mesh painted = *s.scene.meshes.find(s.square);
    painted.parts[0].material = s.scene.materials.add(paint);
    s.scene.meshes.set(s.square, painted);
    const auto blocks = [&](const auto& change) {
        Material m = paint;
        change(m);
        s.scene.materials.set(painted.parts[0].material, m);
        return s.between({0, 0, 0}, {5, 0, 0}).has_value();
    };
    EXPECT_TRUE(blocks([](Material&) {}));
    EXPECT_FALSE(blocks([](Material& m) { m.transmission = 0.5f; }));
    EXPECT_FALSE(blocks([](Material& m) { m.alpha = Material::Alpha::mask; }));
    EXPECT_TRUE(blocks([](Material& m) { m.alpha = Material::Alpha::blend; })) << "of opacity 1";
    EXPECT_FALSE(blocks([](Material& m) { m.alpha = Material::Alpha::blend, m.opacity = 0.5f; }));
}

} // namespace
} // namespace blush::TEST_FILE
