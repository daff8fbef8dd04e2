// Charts in the window and in files: same layout, drawn by ImGui and rasterized without OpenGL; texts of the Convergence panel.
#include "tests/ui/imgui_test.h"
#include "ui/gl/draw_list_image.h"
#include "ui/views/convergence_image.h"
#include "ui/widgets/plot_drawing.h"
#include "ui/window/time_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blush::TEST_FILE {
namespace {

class PlotDrawing : public test::ImGuiFrameTest {
protected:
    static constexpr int width = 40, height = 30;
    template <class Draw> std::vector<float> drawn(const Draw& draw) {
        ImDrawList list(ImGui::GetDrawListSharedData());
        list._ResetForNewFrame();
        list.PushClipRect({0, 0}, {1000, 1000});
        list.PushTextureID(ImGui::GetIO().Fonts->TexID);
        draw(list);
        return rasterize(list, width, height, IM_COL32_BLACK);
    }
    static float red(const std::vector<float>& rgb, int x, int y) { return rgb[3 * size_t(y * width + x)]; }
};

TEST_F(PlotDrawing, ARectangleCoversItsPixelsOnce) {
    const std::vector<float> rgb = drawn([](ImDrawList& list) {
        list.Flags = ImDrawListFlags_None;
        list.AddRectFilled({5, 7}, {25, 22}, IM_COL32(255, 255, 255, 128)); // two triangles: the diagonal must not be drawn twice
    });
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            EXPECT_NEAR(red(rgb, x, y), x >= 5 && x < 25 && y >= 7 && y < 22 ? 128 / 255.f : 0.f, 1e-5f) << x << ", " << y;
}

TEST_F(PlotDrawing, ClipsToClipRectanglesAndTheImage) {
    const std::vector<float> rgb = drawn([](ImDrawList& list) {
        list.PushClipRect({10, 10}, {20, 20}, true);
        list.AddRectFilled({-1e6f, -1e6f}, {1e6f, 1e6f}, IM_COL32_WHITE);
        list.PopClipRect();
    });
    float sum = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) sum += red(rgb, x, y);
    EXPECT_NEAR(sum, 100, 1e-3f);
}

TEST_F(PlotDrawing, DrawsText) {
    const std::vector<float> rgb = drawn([](ImDrawList& list) { list.AddText({2, 2}, IM_COL32_WHITE, "1"); });
    EXPECT_GT(*std::max_element(rgb.begin(), rgb.end()), 0.9f);
    EXPECT_EQ(red(rgb, width - 1, height - 1), 0);
}

TEST_F(PlotDrawing, ChartPointsMatchTheLayout) {
    Plot plot{"title",          "x", "y", {{"a", "#ff0000", {{1, 1}, {10, 0.3}, {100, 0.1, 0.05, 0.2}}}}, {{5, "edit", "#00ff00"}},
              {{0.2, "target"}}};
    const ChartImage image = draw_chart_image(plot);
    ASSERT_EQ(image.rgb.size(), size_t(3 * image.width * image.height));
    const ImFont& font = *ImGui::GetIO().Fonts->Fonts.front();
    plot.y_label.clear();
    const PlotLayout l = compute_plot_layout(plot, plot_metrics({float(image.width), float(image.height)}, font, font.FontSize, true));
    for (const PlotPixel& p : l.curves[0].line) {
        const float* rgb = &image.rgb[3 * (size_t(p.y) * size_t(image.width) + size_t(p.x))];
        EXPECT_GT(rgb[0], 0.9f);
        EXPECT_LT(rgb[1], 0.1f);
    }
    EXPECT_TRUE(std::ranges::all_of(image.rgb, [](float v) { return v >= 0 && v <= 1; }));
    // A chart without curves still has its axes.
    const auto empty = draw_chart_image({});
    const auto [darkest, brightest] = std::ranges::minmax_element(empty.rgb);
    EXPECT_GT(*brightest - *darkest, 0.1f);
}

TEST(PlotColors, AreParsedOrBlack) {
    EXPECT_EQ(parse_color("#0180ff"), IM_COL32(1, 128, 255, 255));
    EXPECT_EQ(parse_color("#0180ff", 0.5f), IM_COL32(1, 128, 255, 128));
    for (const char* bad : {"", "#12", "0180ff7", "#01 0ff", "#0180ff0"}) EXPECT_EQ(parse_color(bad), IM_COL32(0, 0, 0, 255)) << bad;
}

TEST(ConvergenceTexts, ShowUnknownValuesAsUnknown) {
    using State = TimeLeft::State;
    EXPECT_EQ(error_text({}), "not known yet");
    EXPECT_EQ(error_text({false, 0.01234, 0, 0}), "0.0123");
    EXPECT_EQ(error_text({true, 0.0123, 0.0119, 0.0127}), "0.0123 (0.0119 to 0.0127)");
    EXPECT_EQ(slope_text({}), "slope not known yet");
    EXPECT_EQ(slope_text({true, -0.49, -0.52, 0.01}), "slope −0.49 (−0.52 to 0.01)");
    EXPECT_EQ(time_left_text({State::reached}), "target reached");
    EXPECT_EQ(time_left_text({State::known, 12, 9.14, 160}), "target in 12 s (9.1 s to 2.7 min)");
    EXPECT_EQ(time_left_text({State::known, 12, 12, 12}), "target in 12 s");
    EXPECT_NE(time_left_text({State::too_few}).find("not known yet"), std::string::npos);
    EXPECT_EQ(share_text(0.00301), "0.31 %") << "never rounded to less";
    EXPECT_EQ(share_text(0.003), "0.30 %");
    EXPECT_EQ(share_text(1e-9), "0.01 %");
    EXPECT_EQ(elapsed_text(61.9), "1:01 min");
    EXPECT_EQ(guessed_time_text(std::numeric_limits<double>::infinity()), "years");
    EXPECT_EQ(elapsed_text(std::numeric_limits<double>::infinity()), "-");
    EXPECT_EQ(elapsed_text(std::numeric_limits<double>::quiet_NaN()), "-");
    EXPECT_EQ(guessed_time_text(7200), "2.0 h");
    const ConvergencePoint p{ConvergencePoint::Kind::denoised, 2, 64, {true, 0.5, 0.4, 0.6}, {}};
    EXPECT_EQ(readout_text("run", p, ErrorMetric::rmse), "run\ndenoised image\n2.0 s   64 spp\nRMSE 0.5 (0.4 to 0.6)");
    EXPECT_EQ(readout_text("run", p, ErrorMetric::relmse), "run\ndenoised image\n2.0 s   64 spp\nrelMSE not known yet");
}

} // namespace
} // namespace blush::TEST_FILE
