// Picking from a frame's planes.
#include "ui/viewport/picking.h"

#include "core/math.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

// 2 x 2: only the lower right pixel has a hit, at 4 metres.
Frame sample_frame() {
    Frame f;
    f.width = f.height = 2;
    f.object_id = {0, 0, 0, 7};
    f.material_id = {0, 0, 0, 3};
    f.depth = {0, 0, 0, 4};
    return f;
}

TEST(Pick, ReadsThePixelUnderTheMouse) {
    const Picked p = pick(sample_frame(), 0.75, 0.6);
    EXPECT_EQ(p.node.value, 7u);
    EXPECT_EQ(p.material.value, 3u);
    ASSERT_TRUE(p.depth);
    EXPECT_EQ(*p.depth, 4);
}

TEST(Pick, MissIsEmpty) {
    const Picked p = pick(sample_frame(), 0.25, 0.6);
    EXPECT_FALSE(p.node);
    EXPECT_FALSE(p.depth);
}

TEST(Pick, OutsideTheImageOrItsPlanesIsEmpty) {
    for (const auto& [u, v] : {std::pair{-0.1, 0.5}, {1.0, 0.5}, {0.5, 1.0}, {0.5, -1e-9}}) EXPECT_FALSE(pick(sample_frame(), u, v).node);
    EXPECT_FALSE(pick(Frame{}, 0.5, 0.5).depth);
    Frame bare = sample_frame();
    bare.object_id.clear();
    bare.depth.clear();
    EXPECT_FALSE(pick(bare, 0.75, 0.75).node);
    EXPECT_FALSE(seen_point(bare, Projection(View{}, 1), 0.75, 0.75));
}

TEST(SeenPoint, IsOnTheRayAtItsDepth) {
    const Projection projection(View{}, 1);
    const auto point = seen_point(sample_frame(), projection, 0.75, 0.75);
    ASSERT_TRUE(point);
    const ViewRay ray = projection.ray(0.75, 0.75);
    const Vec3d d = *point - (ray.origin + ray.direction * 4.0);
    EXPECT_NEAR(length(d), 0, 1e-12);
}

} // namespace
} // namespace blush::TEST_FILE
