// Names that the window and the light mix show for objects.
#include "scene/node_name.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

TEST(NodeName, IsThatOfTheNodeElseOfWhatItHolds) {
    Scene scene;
    Light light;
    light.kind = Light::Kind::spot;
    Node node;
    node.light = scene.lights.add(light);
    const Id<Node> id = scene.nodes.add(node);
    EXPECT_EQ(node_name(scene, id, node), "Spot");
    light.name = "Point.001";
    scene.lights.set(node.light, light);
    EXPECT_EQ(node_name(scene, id, node), "Point.001");
    node.name = "Key";
    EXPECT_EQ(node_name(scene, id, node), "Key");

    Node object;
    object.mesh = scene.meshes.add({"Chair", {}});
    EXPECT_EQ(node_name(scene, {7}, object), "Chair");
    EXPECT_EQ(node_name(scene, {7}, Node{}), "Node 7");
}

} // namespace
} // namespace blush::TEST_FILE
