#include "render/denoise/unet_plan.h"

#include <gtest/gtest.h>

namespace blush::test::TEST_FILE {
namespace {

using namespace denoise;

constexpr UnetChannels base{9, 32, 32, 48, 64, 80, 96, 96, 112, 112, 96, 96, 64, 64, 64, 32, 3};

size_t end_of(const UnetPlan& plan, int plane) {
    const UnetPlane& p = plan.planes[plane];
    return p.offset + p.row_bytes() * (p.height + 2);
}

bool reads(int layer, int plane) { return plane == layer || unet_layers[layer].skip == plane; }

TEST(UnetPlan, PlanesHaveTheSizesOfTheirLevels) {
    const UnetPlan plan = plan_unet(base, 64, 32, Element::float32);
    const int divisors[unet_plane_count]{1, 1, 2, 4, 8, 16, 16, 16, 8, 8, 4, 4, 2, 2, 1, 1, 1};
    for (int i = 0; i < unet_plane_count; i++) {
        EXPECT_EQ(plan.planes[i].width, 64 / divisors[i]) << i;
        EXPECT_EQ(plan.planes[i].height, 32 / divisors[i]) << i;
        EXPECT_EQ(plan.planes[i].channels, base[i]) << i;
    }
}

TEST(UnetPlan, Bfloat16ComesInTwoPartsAndEndsInFloat32) {
    const UnetPlan plan = plan_unet(base, 64, 32, Element::bfloat16);
    EXPECT_EQ(plan.planes[0].channels, base[0] + split_channels);
    for (int i = 0; i < unet_plane_count; i++)
        EXPECT_EQ(plan.planes[i].element, i + 2 < unet_plane_count ? Element::bfloat16 : Element::float32) << i;
}

// While layer i runs, its output and all planes that it or a later layer still reads must not overlap.
TEST(UnetPlan, LivePlanesDoNotOverlap) {
    for (const Element element : {Element::float32, Element::bfloat16})
        for (const auto& [width, height] : {std::pair{16, 16}, {208, 160}, {1280, 720}, {16, 4096}}) {
            const UnetPlan plan = plan_unet(base, width, height, element);
            for (int layer = 0; layer + 1 < unet_layer_count; layer++)
                for (int plane = 0; plane <= layer; plane++) {
                    bool needed = false;
                    for (int later = layer; later < unet_layer_count; later++) needed = needed || reads(later, plane);
                    if (!needed) continue;
                    const bool apart =
                        end_of(plan, plane) <= plan.planes[layer + 1].offset || end_of(plan, layer + 1) <= plan.planes[plane].offset;
                    EXPECT_TRUE(apart) << "planes " << plane << " and " << layer + 1 << " at " << width << "x" << height;
                }
            for (int plane = 0; plane + 1 < unet_plane_count; plane++) EXPECT_LE(end_of(plan, plane), plan.plane_bytes);
        }
}

TEST(UnetPlan, SharesMemory) {
    const UnetPlan plan = plan_unet(base, 1280, 720, Element::float32);
    size_t all = 0;
    for (int plane = 0; plane + 1 < unet_plane_count; plane++) all += end_of(plan, plane) - plan.planes[plane].offset;
    EXPECT_LT(plan.plane_bytes, 0.7 * double(all));
    // The peak: the planes of the last layers but two, 64 and 32 channels of full size.
    EXPECT_GE(plan.plane_bytes, size_t(1280) * 720 * 96 * 4);
}

} // namespace
} // namespace blush::test::TEST_FILE
