// The polar plot shows the light's candela per direction.
#include "ui/widgets/polar_plot.h"

#include <gtest/gtest.h>

#include <cmath>

namespace blush::TEST_FILE {
namespace {

TEST(PolarPlot, HasTheCandelaPerDirection) {
    IesProfile p;
    p.vertical = {0, 90, 180};
    p.horizontal = {0, 90, 180, 270, 360};
    p.candela = {100, 50, 0, 100, 80, 0, 100, 10, 0, 100, 20, 0, 100, 50, 0};
    p.peak = 100;
    Light light;
    const std::vector<PolarPoint> across = polar_curve(p, light, 0), along = polar_curve(p, light, 90);
    ASSERT_EQ(across.size(), 361u);
    EXPECT_NEAR(across[180].y, -1, 1e-9) << "ahead is down";
    EXPECT_NEAR(across[270].x, 0.5, 1e-9) << "+X to the right";
    EXPECT_NEAR(across[90].x, -0.1, 1e-9) << "-X to the left";
    EXPECT_NEAR(along[270].x, 0.8, 1e-9) << "+Y";
    EXPECT_NEAR(along[90].x, -0.2, 1e-9);
    EXPECT_NEAR(std::hypot(across[0].x, across[0].y), 0, 1e-9) << "nothing behind";

    light.kind = Light::Kind::spot;
    light.outer_cone_radians = 0.5f;
    EXPECT_NEAR(polar_curve(p, light, 0)[270].x, 0, 1e-9) << "beyond the cone";
    EXPECT_NEAR(polar_curve(p, light, 0)[180].y, -1, 1e-9);
}

} // namespace
} // namespace blush::TEST_FILE
