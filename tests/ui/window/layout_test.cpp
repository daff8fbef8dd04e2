// The window's regions: no gaps or overlaps, and a minimum size of the viewport.
#include "ui/window/layout.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace blush::TEST_FILE {
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

TEST(Layout, RowBelowTheImageReducesItsHeight) {
    const Layout without = lay_out(1280, 801, 22, 27, 15, {}), with = lay_out(1280, 801, 22, 27, 15, {}, {.time = 30});
    EXPECT_EQ(without.time.height, 0);
    EXPECT_EQ(with.time.height, 30);
    EXPECT_EQ(with.viewport.height, without.viewport.height - 30);
    EXPECT_EQ(with.time.y, with.viewport.y + with.viewport.height);
    EXPECT_EQ(with.time.y + with.time.height, with.status.y);
    EXPECT_EQ(with.time.x, with.viewport.x);
    EXPECT_EQ(with.time.width, with.viewport.width);
    EXPECT_EQ(with.inspector, without.inspector);
}

TEST(Layout, ViewportKeepsAMinimumWidth) {
    const Layout l = lay_out(480, 400, 22, 27, 15, {45, 45});
    EXPECT_EQ(l.viewport.width, 15 * 16);
    EXPECT_EQ(l.outliner.width, 120) << "the side panels share the rest";
    EXPECT_EQ(l.inspector.width, 120);
}

TEST(Layout, TinyWindowHasAViewport) {
    const Layout l = lay_out(10, 10, 22, 27, 15, {});
    EXPECT_EQ(l.viewport.width, 10) << "the side panels give way";
    EXPECT_EQ(l.viewport.height, 1) << "menu and status bar do not fit either";
}

constexpr ViewportInsets everything{true, true, {}, 150, 22};

bool overlap(const Region& a, const Region& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}
float area(const Region& r) { return r.width * r.height; }

TEST(Layout, DocksAndStripReduceTheImage) {
    for (const float width : {480.f, 800.f, 1280.f, 1720.f, 2560.f})
        for (const float height : {320.f, 720.f, 960.f, 1440.f})
            for (const float font : {12.f, 15.f, 30.f, 60.f})
                for (int open = 0; open < 16; ++open) {
                    const ViewportInsets beside{(open & 1) != 0, (open & 2) != 0, {}, open & 4 ? 10 * font : 0, open & 8 ? 2 * font : 0};
                    const Layout l = lay_out(width, height, 22, 27, font, {}, beside);
                    const Region all[] = {l.viewport, l.strip, l.time, l.right_dock, l.bottom_dock, l.outliner, l.inspector, l.status};
                    for (const Region& a : all) {
                        EXPECT_GE(a.width, 0);
                        EXPECT_GE(a.height, 0);
                        for (const Region& b : all)
                            EXPECT_TRUE(&a == &b || !overlap(a, b)) << width << " x " << height << " font " << font << " open " << open;
                    }
                    // No gap between them.
                    const float body = l.room.width * (l.status.y - l.room.y);
                    EXPECT_NEAR(area(l.viewport) + area(l.strip) + area(l.time) + area(l.right_dock) + area(l.bottom_dock), body,
                                1e-3f * body);
                    EXPECT_GE(l.viewport.height, std::min(9 * font, 0.3f * (l.status.y - l.room.y)) - 1) << "the image can be seen";
                }
}

TEST(Layout, ImageSizeDoesNotDependOnOpenDocks) {
    const Layout closed = lay_out(1720, 960, 22, 27, 15, {}), open = lay_out(1720, 960, 22, 27, 15, {}, {true, true, {}, 150, 0});
    EXPECT_EQ(closed.viewport, closed.room) << "nothing changes while no instrument is open";
    EXPECT_EQ(open.room, closed.room);
    EXPECT_LT(open.viewport.width, closed.viewport.width);
    EXPECT_LT(open.viewport.height, closed.viewport.height);
}

TEST(Layout, NarrowRoomHasNoRightDock) {
    const Layout narrow = lay_out(1280, 720, 44, 54, 30, {}, everything), wide = lay_out(1280, 720, 22, 27, 15, {}, everything);
    EXPECT_FALSE(has_right_dock(narrow.room, 30));
    EXPECT_EQ(narrow.right_dock.width, 0);
    EXPECT_TRUE(has_right_dock(wide.room, 15));
    EXPECT_GE(wide.right_dock.width, 15 * 15);
    EXPECT_GE(wide.viewport.width, 15 * 16);
}

TEST(DockRegions, SizesAreClampedToTheWindow) {
    const Layout l = lay_out(1720, 960, 22, 27, 15, {}, everything);
    const float right = l.right_dock.x + l.right_dock.width, bottom = l.bottom_dock.y + l.bottom_dock.height;
    EXPECT_FLOAT_EQ(drag_right_dock({}, right - 450, l, 15).right, 30);
    EXPECT_FLOAT_EQ(drag_bottom_dock({}, bottom - 300, l, 15).bottom, 20);
    for (const float at : {-1e6f, 1e6f}) {
        const DockSizes sizes = drag_bottom_dock(drag_right_dock({}, at, l, 15), at, l, 15);
        const Layout dragged = lay_out(1720, 960, 22, 27, 15, {}, {true, true, sizes, 0, 0});
        EXPECT_NEAR(dragged.right_dock.width, 15 * sizes.right, 1);
        EXPECT_NEAR(dragged.bottom_dock.height, 15 * sizes.bottom, 1);
        EXPECT_GE(dragged.viewport.width, 15 * 16 - 1);
        EXPECT_GE(dragged.viewport.height, 15 * 9 - 1);
    }
}

TEST(DockRegions, AcceptDropsOnTabsAndAtEdges) {
    const Layout closed = lay_out(1720, 960, 22, 27, 15, {}), open = lay_out(1720, 960, 22, 27, 15, {}, everything);
    const Region& v = closed.viewport;
    EXPECT_EQ(dock_at(closed, v.x + v.width - 5, v.y + 200, 15), DockSide::right);
    EXPECT_EQ(dock_at(closed, v.x + 200, v.y + v.height - 5, 15), DockSide::bottom);
    EXPECT_EQ(dock_at(closed, v.x + 200, v.y + 200, 15), std::nullopt);
    EXPECT_EQ(dock_at(closed, 5, 200, 15), std::nullopt) << "the outliner is no dock";
    EXPECT_EQ(dock_at(open, open.right_dock.x + 50, open.right_dock.y + 5, 15), DockSide::right);
    EXPECT_EQ(dock_at(open, open.bottom_dock.x + 50, open.bottom_dock.y + 5, 15), DockSide::bottom);
    EXPECT_EQ(dock_at(open, open.bottom_dock.x + 50, open.bottom_dock.y + 60, 15), std::nullopt);
    const Layout narrow = lay_out(1280, 720, 44, 54, 30, {});
    EXPECT_EQ(dock_at(narrow, narrow.viewport.x + narrow.viewport.width - 5, 300, 30), std::nullopt) << "there is no room on the right";
}

TEST(Splitters, FollowTheMouseWithinLimits) {
    EXPECT_FLOAT_EQ(drag_outliner({}, 300, 15).outliner, 20);
    EXPECT_FLOAT_EQ(drag_inspector({}, 980, 1280, 15).inspector, 20);
    for (const float font : {13.f, 15.f, 30.f}) {
        EXPECT_FLOAT_EQ(drag_outliner({}, -50, font).outliner, 10);
        EXPECT_FLOAT_EQ(drag_outliner({}, 1e6f, font).outliner, 45);
        EXPECT_FLOAT_EQ(drag_inspector({}, 1e6f, 1280, font).inspector, 10);
        EXPECT_FLOAT_EQ(drag_inspector({}, 0, 1e6f, font).inspector, 45);
    }
}

TEST(FitAspect, IsTheLargestCentredRectangle) {
    const Region wide = fit_aspect({10, 20, 1000, 500}, 1);
    EXPECT_EQ(wide, (Region{260, 20, 500, 500}));
    const Region high = fit_aspect({0, 0, 400, 900}, 2);
    EXPECT_EQ(high, (Region{0, 350, 400, 200}));
    EXPECT_EQ(fit_aspect({5, 6, 640, 360}, 640.f / 360.f), (Region{5, 6, 640, 360}));
}

} // namespace
} // namespace blush::TEST_FILE
