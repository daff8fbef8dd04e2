// Zoom and pan of the image.
#include "tests/ui/imgui_test.h"
#include "ui/viewport/image_zoom.h"
#include "ui/viewport/pixel_grid.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

constexpr Region region{100, 50, 800, 600};

void expect_rect(const ImageRect& got, const ImageRect& wanted) {
    EXPECT_EQ(got.x, wanted.x);
    EXPECT_EQ(got.y, wanted.y);
    EXPECT_EQ(got.width, wanted.width);
    EXPECT_EQ(got.height, wanted.height);
}

TEST(ImageZoom, TogglesFitAndOneToOne) {
    expect_rect(image_rect({}, region, 1600, 900), {100, 125, 800, 450});
    const ImageZoom one = toggled({});
    expect_rect(image_rect(one, region, 1600, 900), {-300, -100, 1600, 900});
    expect_rect(image_rect(one, region, 400, 300), {300, 200, 400, 300});
    EXPECT_EQ(toggled(one), ImageZoom{});
}

TEST(ImageZoom, ZoomsAboutTheMouse) {
    ImageZoom zoom;
    const ScreenPoint mouse{333, 222};
    const ImageRect before = image_rect(zoom, region, 1600, 900);
    const double u = before.u(mouse.x), v = before.v(mouse.y);
    for (int i = 0; i < 12; ++i) {
        zoom = zoomed(zoom, region, 1600, 900, mouse, 1.5);
        const ImageRect now = image_rect(zoom, region, 1600, 900);
        EXPECT_NEAR(now.u(mouse.x) * now.width, u * now.width, 1) << "on whole pixels of the screen";
        EXPECT_NEAR(now.v(mouse.y) * now.height, v * now.height, 1);
    }
    EXPECT_GT(zoom.scale, 60);
}

TEST(ImageZoom, IsClampedToFitAndMaximum) {
    ImageZoom zoom;
    for (int i = 0; i < 100; ++i) zoom = zoomed(zoom, region, 1600, 900, {500, 350}, 2);
    EXPECT_EQ(zoom.scale, max_zoom);
    for (int i = 0; i < 100; ++i) zoom = zoomed(zoom, region, 1600, 900, {500, 350}, 0.5);
    EXPECT_EQ(zoom, ImageZoom{});
}

TEST(ImageZoom, PanKeepsTheCentreInsideTheImage) {
    const ImageZoom one = toggled({});
    const ImageZoom moved = shifted(one, region, 1600, 900, -160, 90);
    const ImageRect before = image_rect(one, region, 1600, 900), after = image_rect(moved, region, 1600, 900);
    EXPECT_EQ(after.x, before.x - 160);
    EXPECT_EQ(after.y, before.y + 90);
    EXPECT_EQ(shifted(one, region, 1600, 900, -1e6, 1e6), (ImageZoom{1, 1, 0}));
    EXPECT_EQ(shifted({}, region, 1600, 900, 50, 50), ImageZoom{}) << "fit is not panned";
}

// Pixels of a coarse preview have no grid.
class PixelGrid : public test::ImGuiTest {
protected:
    int lines_over(int divider) {
        Frame frame;
        frame.width = frame.height = 4;
        frame.divider = divider;
        frame.rgba.assign(64, 0.5f);
        int drawn = 0;
        in_window([&] {
            ImDrawList& draw = *ImGui::GetWindowDrawList();
            const int before = draw.VtxBuffer.Size;
            draw_pixel_grid(draw, {0, 0, 320, 320}, {0, 0, 400, 400}, frame);
            drawn = draw.VtxBuffer.Size - before;
        });
        return drawn;
    }
};

TEST_F(PixelGrid, IsDrawnOnlyAtFullResolution) {
    EXPECT_GT(lines_over(1), 40);
    for (const int divider : {2, 4, 8}) EXPECT_EQ(lines_over(divider), 0);
}

} // namespace
} // namespace blush::TEST_FILE
