// Docks of the instruments: sides, order, and saved state.
#include "tests/support/sample_project.h"
#include "tests/ui/imgui_test.h"
#include "tests/ui/shipped_ocio_config.h"
#include "ui/panels/instruments.h"
#include "ui/window/docks.h"
#include "ui/window/ui_persistence.h"

#include <imgui_internal.h>

namespace blush::TEST_FILE {
namespace {

using Ids = std::vector<std::string>;

Dock three() {
    Dock dock;
    place_of(dock, "a", DockSide::right);
    place_of(dock, "b", DockSide::bottom);
    place_of(dock, "c", DockSide::right);
    return dock;
}

TEST(Dock, InstrumentsHaveSideAndOrder) {
    Dock dock = three();
    const Ids open{"c", "b", "a"};
    EXPECT_EQ(tabs_on(dock, DockSide::right, open, true), (Ids{"a", "c"}));
    EXPECT_EQ(tabs_on(dock, DockSide::bottom, open, true), (Ids{"b"}));
    EXPECT_EQ(tabs_on(dock, DockSide::bottom, open, false), (Ids{"a", "b", "c"})) << "without a right dock all are at the bottom";
    EXPECT_TRUE(tabs_on(dock, DockSide::right, open, false).empty());
    place_of(dock, "c", DockSide::bottom).floats = true;
    EXPECT_EQ(tabs_on(dock, DockSide::right, open, true), (Ids{"a"}));
    EXPECT_EQ(floating(dock, open), (Ids{"c"}));
    EXPECT_TRUE(floating(dock, Ids{"a"}).empty()) << "closed";
    EXPECT_EQ(dock.tabs.size(), 3u);
    dock_all(dock);
    EXPECT_EQ(tabs_on(dock, DockSide::right, open, true), (Ids{"a", "c"})) << "back on its side";
}

TEST(Dock, DraggingReordersTabs) {
    Dock dock = three();
    reorder(dock, Ids{"c", "a"});
    EXPECT_EQ(tabs_on(dock, DockSide::right, Ids{"a", "b", "c"}, true), (Ids{"c", "a"}));
    EXPECT_EQ(dock.tabs[1].id, "b") << "others keep their places";
    reorder(dock, Ids{"unknown"});
    EXPECT_EQ(dock.tabs.size(), 3u);
}

TEST(Instruments, HaveUniqueNames) {
    for (const Instrument& a : instruments())
        for (const Instrument& b : instruments()) {
            if (&a == &b) continue;
            EXPECT_STRNE(a.id, b.id);
            EXPECT_STRNE(a.title, b.title);
        }
    EXPECT_EQ(find_instrument(instruments(), "unknown"), nullptr);
}

// The docks in a window of 1720 x 960 pixels.
class Docks : public test::ImGuiTest {
protected:
    void frame() {
        ImGui::GetIO().DisplaySize = {1720, 960};
        ImGui::NewFrame();
        PanelContext c = context();
        const float em = ImGui::GetFontSize();
        const ViewportInsets beside = dock_insets(c, instruments(), lay_out(1720, 960, 22, 27, em, {}).room);
        layout = lay_out(1720, 960, 22, 27, em, {}, beside);
        draw_docks(c, instruments(), layout);
        ImGui::EndFrame();
    }
    void frames(int count = 4) {
        for (int i = 0; i < count; ++i) frame();
    }
    PanelContext context() { return {document, ui, color, image, SessionStatus(), 640, 480}; }
    void toggle(const char* id) {
        PanelContext c = context();
        toggle_instrument(c, id);
    }

    Document document{test::sample_project().project};
    const ColorManagement color = test::our_colors();
    UiState ui;
    FramePtr image;
    Layout layout;
};

TEST_F(Docks, KeyOpensBringsToFrontOrCloses) {
    frames();
    EXPECT_EQ(layout.viewport, layout.room) << "nothing is open";
    toggle("scopes");
    frames();
    EXPECT_TRUE(ui.docks.in_sight.contains("scopes"));
    EXPECT_GT(layout.bottom_dock.height, 0);
    toggle("light_table");
    frames();
    EXPECT_TRUE(ui.docks.in_sight.contains("light_table")) << "an opened instrument comes to the front";
    EXPECT_FALSE(ui.docks.in_sight.contains("scopes"));
    toggle("scopes");
    frames();
    EXPECT_TRUE(ui.scopes.open) << "a hidden tab comes to the front";
    EXPECT_TRUE(ui.docks.in_sight.contains("scopes"));
    toggle("scopes");
    frames();
    EXPECT_FALSE(ui.scopes.open);
    EXPECT_TRUE(ui.docks.in_sight.contains("light_table"));
    toggle("light_table");
    frames();
    EXPECT_EQ(layout.viewport, layout.room);
}

TEST_F(Docks, UndockedInstrumentFloats) {
    toggle("history");
    frames();
    EXPECT_GT(layout.right_dock.width, 0);
    place_of(ui.settings.dock, "history", DockSide::right).floats = true;
    frames();
    EXPECT_EQ(layout.right_dock.width, 0);
    EXPECT_TRUE(ImGui::FindWindowByName("History") && ImGui::FindWindowByName("History")->WasActive);
    dock_all(ui.settings.dock);
    frames();
    EXPECT_GT(layout.right_dock.width, 0);
    EXPECT_FALSE(ImGui::FindWindowByName("History")->WasActive);
}

TEST_F(Docks, EveryInstrumentOpensAndClosesDockedAndFloating) {
    for (const Instrument& i : instruments()) {
        if (std::string(i.id) == "comparison" || std::string(i.id) == "snapshot") continue; // there is no snapshot
        PanelContext c = context();
        if (std::string(i.id) == "region") ui.docks.open.clear();
        i.set_open(c, true);
        const bool opens = i.is_open(c);
        for (const DockSide side : {DockSide::right, DockSide::bottom})
            for (const bool floats : {false, true}) {
                place_of(ui.settings.dock, i.id, side) = {i.id, side, floats};
                frames(3);
                EXPECT_EQ(ui.docks.in_sight.contains(i.id), opens) << i.id;
            }
        i.set_open(c, false);
        EXPECT_FALSE(i.is_open(c)) << i.id;
        frames();
        EXPECT_EQ(layout.viewport, layout.room) << i.id;
    }
    EXPECT_FALSE(document.can_undo()) << "drawing edits nothing";
}

TEST_F(Docks, ReopenOnlyWithTheirScene) {
    toggle("scopes");
    toggle("history");
    frames();
    ui.settings.dock.sizes.right = 31;
    save_scene_ui(ui, "/a.gltf", ui.settings);
    const std::string front = ui.settings.dock.front[size_t(DockSide::bottom)];
    EXPECT_EQ(front, "scopes");
    UiState again;
    again.settings = ui.settings;
    std::swap(ui, again);
    restore_instruments(context(), "/b.gltf");
    EXPECT_FALSE(ui.scopes.open || ui.show_history);
    restore_instruments(context(), "/a.gltf");
    EXPECT_TRUE(ui.scopes.open && ui.show_history);
    frames();
    EXPECT_EQ(layout.right_dock.width, std::round(31 * ImGui::GetFontSize()));
}

} // namespace
} // namespace blush::TEST_FILE
