// The Integrators panel: it renders only while it is open, drawing it edits nothing, other knobs start it again, its text is readable.
#include "tests/support/eventually.h"
#include "tests/support/process.h"
#include "tests/support/sample_project.h"
#include "tests/ui/clipped_text.h"
#include "tests/ui/imgui_test.h"
#include "tests/ui/shipped_ocio_config.h"
#include "ui/panels/instruments.h"
#include "ui/panels/integrators/integrator_fields.h"
#include "ui/panels/panels.h"
#include "ui/window/theme.h"

#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace blush::TEST_FILE {
namespace {

using Kind = BiasedIntegrator::Kind;
using Show = IntegratorsView::Show;

class IntegratorsPanel : public test::ImGuiTest {
protected:
    IntegratorsPanel() { ui.probe = Probe(folder / "probe.json"); }
    PanelContext context() { return {document, ui, color, nullptr, SessionStatus(), 64, 48}; }
    void draw() {
        ui.probe.begin_frame();
        in_window([&] {
            PanelContext c = context();
            draw_integrators_panel(c);
        });
        ui.probe.end_frame({});
    }
    void draw_in_a_dock(const IntegratorReport& report, const ImVec2& ems) {
        for (int i = 0; i < 3; ++i) {
            ImGui::NewFrame();
            const float em = ImGui::GetFontSize();
            ImGui::GetIO().DisplaySize = {ems.x * em + 50, ems.y * em + 50};
            ImGui::SetNextWindowPos({0, 0});
            ImGui::SetNextWindowSize({ems.x * em, ems.y * em});
            ImGui::Begin("dock", nullptr, ImGuiWindowFlags_NoDecoration ^ ImGuiWindowFlags_NoScrollbar);
            PanelContext c = context();
            draw_integrator_report(c, &report);
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
        find_instrument(instruments(), "integrators")->set_open(c, open);
    }
    bool has_rounds(int64_t rounds) {
        return test::eventually([&] {
            draw();
            return ui.integrators.state.output && ui.integrators.state.output->rounds >= rounds;
        });
    }

    test::TemporaryFolder folder;
    const ColorManagement color = test::our_colors();
    Document document{test::sample_project().project};
    UiState ui;
};

TEST_F(IntegratorsPanel, RendersWhileItIsOpen) {
    const Project before = document.project();
    EXPECT_FALSE(ui.integrators.runner);
    set_open(true);
    EXPECT_FALSE(ui.integrators.runner) << "nothing is drawn yet";
    ASSERT_TRUE(has_rounds(2));
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
    BiasedIntegrator integrator{.kind = Kind::ambient};
    const IntegratorWork::Input now(scene, r, integrator);
    EXPECT_TRUE(now.has_same_result(IntegratorWork::Input(scene, r, integrator)));
    integrator.distance = 2;
    EXPECT_FALSE(now.has_same_result(IntegratorWork::Input(scene, r, integrator)));
    RenderSettings other = r;
    other.max_bounces = 1;
    EXPECT_FALSE(now.has_same_result(IntegratorWork::Input(scene, other, BiasedIntegrator{.kind = Kind::ambient})));
    other = r;
    other.region = {0.1f, 0.1f, 0.5f, 0.5f};
    EXPECT_TRUE(now.has_same_result(IntegratorWork::Input(scene, other, BiasedIntegrator{.kind = Kind::ambient})));

    set_open(true);
    ASSERT_TRUE(has_rounds(1));
    ui.integrators.integrator.distance = 3;
    draw();
    EXPECT_FALSE(ui.integrators.state.output) << "the report of other knobs is not shown";
    ASSERT_TRUE(has_rounds(1));
}

TEST_F(IntegratorsPanel, AnotherIntegratorHasItsDefaults) {
    BiasedIntegrator i{.kind = Kind::ambient, .distance = 7};
    choose_integrator(i, Kind::ambient);
    EXPECT_EQ(i.distance, 7) << "the same one keeps its knobs";
    choose_integrator(i, Kind::photon_map);
    EXPECT_TRUE(i == BiasedIntegrator{.kind = Kind::photon_map});
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
    for (const float scale : {1.f, 1.5f, 2.f}) {
        ImGui::DestroyContext();
        ImGuiTest::SetUp();
        ImGui::GetIO().Fonts->Clear();
        load_fonts(BLUSH_ASSETS, scale);
        apply_theme(scale);
        ImGui::GetIO().Fonts->Build();
        for (const ImVec2 ems : {ImVec2{25, 40}, ImVec2{35, 20}, ImVec2{48, 15}, ImVec2{80, 17}, ImVec2{120, 40}})
            for (const auto show : {Show::images, Show::wipe, Show::difference})
                for (const Kind kind : {Kind::ambient, Kind::irradiance_cache, Kind::light_probes, Kind::photon_map}) {
                    ui.integrators.show = show;
                    choose_integrator(ui.integrators.integrator, kind);
                    draw_in_a_dock(report, ems);
                    for (const std::string& problem : test::unreadable_text(*ImGui::GetDrawData()))
                        ADD_FAILURE() << ems.x << " x " << ems.y << " ems, scale " << scale << ": " << problem;
                }
    }
}

} // namespace
} // namespace blush::TEST_FILE
