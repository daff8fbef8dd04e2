// The Strategies panel: it renders only while it is open, drawing it edits nothing, and it lists what the report holds.
#include "tests/support/eventually.h"
#include "tests/support/process.h"
#include "tests/support/sample_project.h"
#include "tests/ui/clipped_text.h"
#include "tests/ui/imgui_test.h"
#include "tests/ui/shipped_ocio_config.h"
#include "ui/panels/instruments.h"
#include "ui/panels/panels.h"
#include "ui/window/theme.h"

#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace blush::TEST_FILE {
namespace {

class StrategiesPanel : public test::ImGuiTest {
protected:
    StrategiesPanel() { ui.probe = Probe(folder / "probe.json"); }
    PanelContext context() { return {document, ui, color, nullptr, SessionStatus(), 64, 48}; }
    void draw() {
        ui.probe.begin_frame();
        in_window([&] {
            PanelContext c = context();
            draw_strategies_panel(c);
        });
        ui.probe.end_frame({});
    }
    void draw_in_a_dock(const StrategyReport& report, const ImVec2& ems) {
        for (int i = 0; i < 3; ++i) {
            ImGui::NewFrame();
            const float em = ImGui::GetFontSize();
            ImGui::GetIO().DisplaySize = {ems.x * em + 50, ems.y * em + 50};
            ImGui::SetNextWindowPos({0, 0});
            ImGui::SetNextWindowSize({ems.x * em, ems.y * em});
            ImGui::Begin("dock", nullptr, ImGuiWindowFlags_NoDecoration ^ ImGuiWindowFlags_NoScrollbar);
            PanelContext c = context();
            draw_strategy_report(c, &report);
            ImGui::End();
            ImGui::Render();
        }
    }
    bool shows(const std::string& widget) const {
        std::ifstream in(folder / "probe.json");
        const std::string text(std::istreambuf_iterator<char>(in), {});
        return text.find("\"" + widget) != text.npos;
    }
    void set_open(bool open) {
        PanelContext c = context();
        find_instrument(instruments(), "strategies")->set_open(c, open);
    }
    bool has_rounds(int64_t rounds) {
        return test::eventually([&] {
            draw();
            return ui.strategies.state.output && ui.strategies.state.output->rounds >= rounds;
        });
    }

    test::TemporaryFolder folder;
    const ColorManagement color = test::our_colors();
    Document document{test::sample_project().project};
    UiState ui;
};

TEST_F(StrategiesPanel, RendersWhileItIsOpen) {
    const Project before = document.project();
    EXPECT_FALSE(ui.strategies.runner);
    set_open(true);
    EXPECT_FALSE(ui.strategies.runner) << "nothing is drawn yet";
    ASSERT_TRUE(has_rounds(3));
    draw();
    EXPECT_FALSE(document.can_undo());
    EXPECT_TRUE(document.project() == before) << "drawing edits nothing";
    for (const char* strategy : strategy_names) {
        EXPECT_TRUE(shows(fmt::format("Strategies/{}/", strategy))) << strategy;
        EXPECT_TRUE(shows(fmt::format("Strategies/Chart/{}/", strategy))) << strategy;
    }
    set_open(false);
    EXPECT_FALSE(ui.strategies.runner) << "costs nothing while closed";
    EXPECT_FALSE(ui.strategies.state.output);
}

TEST_F(StrategiesPanel, StartsAgainWithOtherBudgetsAndAfterEdits) {
    set_open(true);
    ui.strategies.budget = StrategyBudget::samples;
    ASSERT_TRUE(has_rounds(2));
    const StrategyWork::Output report = ui.strategies.state.output;
    for (const StrategySide& side : report->sides) EXPECT_EQ(side.samples, report->rounds * strategy_round_samples);

    const RenderSettings& r = document.project().render;
    const Scene& scene = document.project().scene;
    const StrategyWork::Input now(scene, r, StrategyBudget::samples);
    EXPECT_TRUE(now.has_same_result(StrategyWork::Input(scene, r, StrategyBudget::samples)));
    EXPECT_FALSE(now.has_same_result(StrategyWork::Input(scene, r, StrategyBudget::time)));
    RenderSettings other = r;
    other.mis_compensation = !other.mis_compensation;
    EXPECT_FALSE(now.has_same_result(StrategyWork::Input(scene, other, StrategyBudget::samples)));
    other = r;
    other.region = {0.1f, 0.1f, 0.5f, 0.5f};
    other.resolution_scale = 0.5f;
    EXPECT_TRUE(now.has_same_result(StrategyWork::Input(scene, other, StrategyBudget::samples))) << "neither concerns its images";
}

// The longest figures of the panel and all of its notes, in the docks of small and large windows.
TEST_F(StrategiesPanel, IsReadableAtAllSizes) {
    StrategyReport report;
    report.width = 240;
    report.height = 135;
    report.zero_size_lights = 123456;
    const Interval rmse{true, 0.000123456, 0.000012345, 0.0012345}, relmse{true, 1.2345e-12, 1.2345e-13, 1.2345e-11};
    for (StrategySide& side : report.sides) {
        side.samples = 1234567;
        side.seconds = 123456.78;
        side.dropped = 1234567890;
        side.variance.assign(240 * 135, 1.2345e-12f);
        side.record.add({ConvergencePoint::Kind::measured, side.seconds, side.samples, rmse, relmse});
    }
    for (MisPart& part : report.parts) {
        part.weight.assign(240 * 135, 0.5f);
        part.variance = report.mis().variance;
        part.share = 0.5;
    }
    for (const float scale : {1.f, 1.5f, 2.f}) {
        ImGui::DestroyContext();
        ImGuiTest::SetUp();
        ImGui::GetIO().Fonts->Clear();
        load_fonts(BLUSH_ASSETS, scale);
        apply_theme(scale);
        ImGui::GetIO().Fonts->Build();
        for (const ImVec2 ems : {ImVec2{25, 40}, ImVec2{35, 20}, ImVec2{48, 15}, ImVec2{80, 17}, ImVec2{120, 40}})
            for (const auto show : {StrategiesView::Show::image, StrategiesView::Show::mis_weight, StrategiesView::Show::mis_variance}) {
                ui.strategies.show = show;
                draw_in_a_dock(report, ems);
                for (const std::string& problem : test::unreadable_text(*ImGui::GetDrawData()))
                    ADD_FAILURE() << ems.x << " x " << ems.y << " ems, scale " << scale << ": " << problem;
            }
    }
}

} // namespace
} // namespace blush::TEST_FILE
