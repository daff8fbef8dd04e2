// The panel of the path tool.
#include "io/gltf/read/import.h"
#include "tests/support/eventually.h"
#include "tests/ui/imgui_test.h"
#include "tests/ui/shipped_ocio_config.h"
#include "ui/panels/panels.h"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace blush::TEST_FILE {
namespace {

class PathsPanel : public test::ImGuiTest {
protected:
    const ColorManagement color = test::our_colors();
    UiState ui;
    FramePtr frame;
};

TEST_F(PathsPanel, TellsWhatToDoWithoutAPixel) {
    Document document;
    for (int i = 0; i < 3; ++i)
        in_window([&] {
            PanelContext c{document, ui, color, frame, SessionStatus(), 64, 36};
            draw_paths_panel(c);
        });
    EXPECT_FALSE(document.can_undo());
    EXPECT_EQ(ui.tool, ViewTool::none);
}

// The path tool with real paths: rows, sum and charts, without an edit.
TEST_F(PathsPanel, ShowsThePathsOfAPixel) {
    Project project;
    project.scene = import_gltf(BLUSH_ASSETS "/scenes/two-bounces.gltf")->scene;
    Document document(project);
    ui.paths.open = true;
    ui.paths.request = PathWork::Input{project.scene, {}, {{20, 16}}, 64};
    ui.paths.request->settings.width = 64;
    ui.paths.request->settings.height = 36;
    ui.paths.runner = std::make_shared<PathRunner>();
    ui.paths.runner->measure(*ui.paths.request);
    ASSERT_TRUE(test::eventually([&] { return ui.paths.runner->state().rests; }));
    ui.paths.state = ui.paths.runner->state();
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "paths-panel.json";
    ui.probe = Probe(file);
    const auto widgets_of = [&](Document& shown) {
        ui.probe.begin_frame();
        in_window([&] {
            PanelContext c{shown, ui, color, frame, SessionStatus(), 64, 36};
            draw_paths_panel(c);
        });
        ui.probe.end_frame({});
        std::ifstream in(file);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    for (ui.paths.path = 0; ui.paths.path < 64; ui.paths.path += 9) {
        const std::string widgets = widgets_of(document);
        const size_t vertices = ui.paths.shown()->vertices.size();
        EXPECT_NE(widgets.find(fmt::format("\"Paths/Vertex {}\"", vertices - 1)), std::string::npos);
        EXPECT_EQ(widgets.find(fmt::format("\"Paths/Vertex {}\"", vertices)), std::string::npos);
        for (const char* name : {"Contribution", "Mean", "Histogram", "Strategies/NEE", "Bounces/1"})
            EXPECT_NE(widgets.find(fmt::format("\"Paths/{}\"", name)), std::string::npos) << name;
        EXPECT_EQ(widgets.find("Paths/Trace again"), std::string::npos);
    }
    EXPECT_FALSE(document.can_undo());
    // An edit since the click is told.
    const Id<Material> first = project.scene.materials.entries()[0].id;
    Material paint = *project.scene.materials.find(first);
    paint.base_color = {0.1f, 0.1f, 0.1f};
    project.scene.materials.set(first, paint);
    Document edited(project);
    EXPECT_NE(widgets_of(edited).find("Paths/Trace again"), std::string::npos);
    std::filesystem::remove(file);
}

} // namespace
} // namespace blush::TEST_FILE
