// The window's regions: they cover it without a gap and leave the viewport room.
#include "ui/layout.h"

#include <gtest/gtest.h>

namespace blush {
namespace {

TEST(Layout, RegionsCoverTheWindowWithoutGapOrOverlap) {
    for (const float width : {480.f, 800.f, 1280.f, 1921.f, 3840.f}) {
        for (const float font : {13.f, 15.f, 30.f}) {
            const Layout l = lay_out(width, 801, 22, 27, font, {});
            EXPECT_EQ(l.outliner.x, 0);
            EXPECT_EQ(l.outliner.x + l.outliner.width, l.viewport.x);
            EXPECT_EQ(l.viewport.x + l.viewport.width, l.inspector.x);
            EXPECT_EQ(l.inspector.x + l.inspector.width, width);
            EXPECT_EQ(l.viewport.y, 22);
            EXPECT_EQ(l.viewport.y + l.viewport.height, l.status.y);
            EXPECT_EQ(l.status.y + l.status.height, 801);
        }
    }
}

TEST(Layout, ARowBelowThePictureTakesItsHeightFromIt) {
    const Layout without = lay_out(1280, 801, 22, 27, 15, {}), with = lay_out(1280, 801, 22, 27, 15, {}, 30);
    EXPECT_EQ(without.time.height, 0);
    EXPECT_EQ(with.time.height, 30);
    EXPECT_EQ(with.viewport.height, without.viewport.height - 30);
    EXPECT_EQ(with.time.y, with.viewport.y + with.viewport.height);
    EXPECT_EQ(with.time.y + with.time.height, with.status.y);
    EXPECT_EQ(with.time.x, with.viewport.x);
    EXPECT_EQ(with.time.width, with.viewport.width);
    EXPECT_EQ(with.inspector, without.inspector);
}

TEST(Layout, TheViewportKeepsSomeRoom) {
    const Layout l = lay_out(480, 400, 22, 27, 15, {45, 45});
    EXPECT_GE(l.viewport.width, 15 * 16 - 2);
}

TEST(Layout, ATinyWindowStillHasAViewport) {
    const Layout l = lay_out(10, 10, 22, 27, 15, {});
    EXPECT_GE(l.viewport.width, 1);
    EXPECT_GE(l.viewport.height, 1);
}

TEST(Splitters, FollowTheMouseWithinLimits) {
    EXPECT_FLOAT_EQ(drag_outliner({}, 300, 15).outliner, 20);
    EXPECT_FLOAT_EQ(drag_inspector({}, 980, 1280, 15).inspector, 20);
    EXPECT_GT(drag_outliner({}, -50, 15).outliner, 0);
    EXPECT_LT(drag_inspector({}, 0, 1e6f, 15).inspector, 100);
}

TEST(FitAspect, IsTheLargestCentredRectangle) {
    const Region wide = fit_aspect({10, 20, 1000, 500}, 1);
    EXPECT_EQ(wide, (Region{260, 20, 500, 500}));
    const Region high = fit_aspect({0, 0, 400, 900}, 2);
    EXPECT_EQ(high, (Region{0, 350, 400, 200}));
    EXPECT_EQ(fit_aspect({5, 6, 640, 360}, 640.f / 360.f), (Region{5, 6, 640, 360}));
}

} // namespace
} // namespace blush
