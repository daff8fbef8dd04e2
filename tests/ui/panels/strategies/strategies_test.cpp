// The Strategies panel: it renders only while it is open, drawing it edits nothing, and it lists what the report holds.
#include "tests/ui/lab_panel_test.h"

namespace blush::TEST_FILE {
namespace {

class StrategiesPanel : public test::LabPanelTest {
protected:
    StrategiesPanel() : LabPanelTest("strategies", draw_strategies_panel) {}
};

TEST_F(StrategiesPanel, RendersWhileItIsOpen) {
    const Project before = document.project();
    EXPECT_FALSE(ui.strategies.runner);
    set_open(true);
    EXPECT_FALSE(ui.strategies.runner) << "nothing is drawn yet";
    ASSERT_TRUE(has_rounds(ui.strategies, 3));
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
    ASSERT_TRUE(has_rounds(ui.strategies, 2));
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
    expect_readable([&](PanelContext& c) { draw_strategy_report(c, &report); },
                    [&](const std::function<void()>& check) {
                        using Show = StrategiesView::Show;
                        for (const Show show : {Show::image, Show::mis_weight, Show::mis_variance}) {
                            ui.strategies.show = show;
                            check();
                        }
                    });
}

} // namespace
} // namespace blush::TEST_FILE
