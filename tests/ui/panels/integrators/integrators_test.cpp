// The Integrators panel: it renders only while it is open, drawing it edits nothing, other knobs start it again, its text is readable.
#include "tests/ui/lab_panel_test.h"
#include "ui/panels/integrators/integrator_fields.h"

namespace blush::TEST_FILE {
namespace {

using Kind = ComparisonIntegrator::Kind;
using Show = IntegratorsView::Show;

class IntegratorsPanel : public test::LabPanelTest {
protected:
    IntegratorsPanel() : LabPanelTest("integrators", draw_integrators_panel) {}
};

TEST_F(IntegratorsPanel, RendersWhileItIsOpen) {
    const Project before = document.project();
    EXPECT_FALSE(ui.integrators.runner);
    set_open(true);
    EXPECT_FALSE(ui.integrators.runner) << "nothing is drawn yet";
    ASSERT_TRUE(has_rounds(ui.integrators, 2));
    draw();
    EXPECT_FALSE(document.can_undo());
    EXPECT_TRUE(document.project() == before) << "drawing edits nothing";
    for (const char* what : {"Integrators/Path/", "Integrators/Biased/", "Integrators/Verdict/", "Integrators/Chart/Path tracing/"})
        EXPECT_TRUE(shows(what)) << what;
    set_open(false);
    EXPECT_FALSE(ui.integrators.runner) << "costs nothing while closed";
    EXPECT_FALSE(ui.integrators.state.output);
}

TEST_F(IntegratorsPanel, StartsAgainWithOtherKnobsAndAfterEdits) {
    const RenderSettings& r = document.project().render;
    const Scene& scene = document.project().scene;
    ComparisonIntegrator integrator{.kind = Kind::ambient};
    const IntegratorWork::Input now(scene, r, integrator);
    EXPECT_TRUE(now.has_same_result(IntegratorWork::Input(scene, r, integrator)));
    integrator.distance = 2;
    EXPECT_FALSE(now.has_same_result(IntegratorWork::Input(scene, r, integrator)));
    RenderSettings other = r;
    other.max_bounces = 1;
    EXPECT_FALSE(now.has_same_result(IntegratorWork::Input(scene, other, ComparisonIntegrator{.kind = Kind::ambient})));
    other = r;
    other.region = {0.1f, 0.1f, 0.5f, 0.5f};
    EXPECT_TRUE(now.has_same_result(IntegratorWork::Input(scene, other, ComparisonIntegrator{.kind = Kind::ambient})));

    set_open(true);
    ASSERT_TRUE(has_rounds(ui.integrators, 1));
    ui.integrators.integrator.distance = 3;
    draw();
    EXPECT_FALSE(ui.integrators.state.output) << "the report of other knobs is not shown";
    ASSERT_TRUE(has_rounds(ui.integrators, 1));
}

TEST_F(IntegratorsPanel, AnotherIntegratorHasItsDefaults) {
    ComparisonIntegrator i{.kind = Kind::ambient, .distance = 7};
    choose_integrator(i, Kind::ambient);
    EXPECT_EQ(i.distance, 7) << "the same one keeps its knobs";
    choose_integrator(i, Kind::photon_map);
    EXPECT_TRUE(i == ComparisonIntegrator{.kind = Kind::photon_map});
}

// The longest figures of the panel, in the docks of small and large windows.
TEST_F(IntegratorsPanel, IsReadableAtAllSizes) {
    IntegratorReport report;
    report.width = 240;
    report.height = 135;
    const Interval e{true, 0.000123456, 0.000012345, 0.0012345};
    for (IntegratorSide* side : {&report.path, &report.biased}) {
        side->samples = 1234567;
        side->seconds = 123456.78;
        side->noise.add({ConvergencePoint::Kind::estimated, side->seconds, side->samples, e, e});
    }
    report.error.add({ConvergencePoint::Kind::measured, 123456.78, 1234567, e, e});
    report.bias_rmse = report.bias_relmse = e;
    report.verdict.threshold = 1;
    for (int k = 0; k < 64; ++k) {
        RegionBias region{
            .x = k % 8 * 30, .y = k / 8 * 16, .width = 30, .height = 16, .mean = 123.4, .reference = 1, .error = 0.1, .degrees = 1e6};
        report.verdict.regions.push_back(region);
    }
    report.verdict.whole = report.verdict.worst = report.verdict.regions.back();
    report.verdict.biased = true;
    expect_readable([&](PanelContext& c) { draw_integrator_report(c, &report); },
                    [&](const std::function<void()>& check) {
                        for (const auto show : {Show::images, Show::wipe, Show::difference})
                            for (size_t kind = 1; kind <= integrator_names.size(); ++kind) {
                                ui.integrators.show = show;
                                choose_integrator(ui.integrators.integrator, Kind(kind));
                                check();
                            }
                    });
}

} // namespace
} // namespace blush::TEST_FILE
