// The panels that render while they are open, drawn without a window: the strategies and the integrators.
#pragma once

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
#include <functional>
#include <iterator>
#include <string>

namespace blush::test {

class LabPanelTest : public ImGuiTest {
protected:
    LabPanelTest(const char* id, void (*panel)(PanelContext&)) : id_(id), panel_(panel) { ui.probe = Probe(folder / "probe.json"); }
    PanelContext context() { return {document, ui, color, nullptr, SessionStatus(), 64, 48}; }
    void draw() {
        ui.probe.begin_frame();
        in_window([&] {
            PanelContext c = context();
            panel_(c);
        });
        ui.probe.end_frame({});
    }
    bool shows(const std::string& widget) const {
        std::ifstream in(folder / "probe.json");
        const std::string text(std::istreambuf_iterator<char>(in), {});
        return text.find("\"" + widget) != text.npos;
    }
    void set_open(bool open) {
        PanelContext c = context();
        find_instrument(instruments(), id_)->set_open(c, open);
    }
    // Draws until the view has a report of so many rounds.
    template <class View> bool has_rounds(const View& view, int64_t rounds) {
        return eventually([&] {
            draw();
            return view.state.output && view.state.output->rounds >= rounds;
        });
    }
    // Draws a report in docks of small and large windows, and fails where text is clipped. `each`: calls its argument for each choice of
    // the panel.
    void expect_readable(const std::function<void(PanelContext&)>& report, const std::function<void(const std::function<void()>&)>& each) {
        for (const float scale : {1.f, 1.5f, 2.f}) {
            ImGui::DestroyContext();
            ImGuiTest::SetUp();
            ImGui::GetIO().Fonts->Clear();
            load_fonts(BLUSH_ASSETS, scale);
            apply_theme(scale);
            ImGui::GetIO().Fonts->Build();
            for (const ImVec2 ems : {ImVec2{25, 40}, ImVec2{35, 20}, ImVec2{48, 15}, ImVec2{80, 17}, ImVec2{120, 40}})
                each([&] {
                    draw_in_a_dock(report, ems);
                    for (const std::string& problem : unreadable_text(*ImGui::GetDrawData()))
                        ADD_FAILURE() << ems.x << " x " << ems.y << " ems, scale " << scale << ": " << problem;
                });
        }
    }

    TemporaryFolder folder;
    const ColorManagement color = our_colors();
    Document document{sample_project().project};
    UiState ui;

private:
    void draw_in_a_dock(const std::function<void(PanelContext&)>& report, const ImVec2& ems) {
        for (int i = 0; i < 3; ++i) {
            ImGui::NewFrame();
            const float em = ImGui::GetFontSize();
            ImGui::GetIO().DisplaySize = {ems.x * em + 50, ems.y * em + 50};
            ImGui::SetNextWindowPos({0, 0});
            ImGui::SetNextWindowSize({ems.x * em, ems.y * em});
            ImGui::Begin("dock", nullptr, ImGuiWindowFlags_NoDecoration ^ ImGuiWindowFlags_NoScrollbar);
            PanelContext c = context();
            report(c);
            ImGui::End();
            ImGui::Render();
        }
    }

    const char* id_;
    void (*panel_)(PanelContext&);
};

} // namespace blush::test
