#include "measure/statistics/bounce_energy.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

TEST(PlaneEnergy, IsTheMeanAndItsShareOfLuminance) {
    Frame frame;
    frame.bounces = {{{1, 1, 1}, {3, 3, 3}}, {{0.5f, 0, 1}, {0.5f, 0, 0}}, {{1, 1, 1}, {1, 1, 1}}};
    const std::vector<PlaneEnergy> energies = bounce_energy(frame);
    ASSERT_EQ(energies.size(), 3u);
    EXPECT_EQ(energies[0].name, "0");
    EXPECT_EQ(energies[2].name, "2+");
    EXPECT_EQ(energies[1].mean, (Vec3d{0.5, 0, 0.5}));
    // Y of linear Rec.709.
    const double second = 0.5 * 0.212671 + 0.5 * 0.072169;
    EXPECT_NEAR(energies[0].share, 2 / (3 + second), 1e-6);
    EXPECT_NEAR(energies[1].share, second / (3 + second), 1e-6);
}

TEST(PlaneEnergy, OfABlackImageOrOneWithoutPlanes) {
    EXPECT_TRUE(bounce_energy({}).empty());
    Frame black;
    black.bounces = {{{0, 0, 0}}, {{0, 0, 0}}};
    EXPECT_EQ(bounce_energy(black)[0].share, 0);
}

} // namespace
} // namespace blush::TEST_FILE
