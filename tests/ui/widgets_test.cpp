// Value editors driven by a simulated mouse and keyboard, without a window: ImGui needs neither.
#include "imgui_test.h"
#include "ui/widgets.h"

#include <imgui_internal.h>

namespace blush {
namespace {

class Widgets : public test::ImGuiTest {
protected:
    void SetUp() override {
        ImGuiTest::SetUp();
        frame(); // ImGui lays a window out in its first frame
        frame();
    }

    // One frame of a panel that edits the exposure, as panels do.
    void frame() {
        in_window([&] {
            ViewSettings v = document.project().view;
            Fields f(ui, "Panel");
            f.number("Exposure", v.exposure_ev, style);
            low = ImGui::GetItemRectMin();
            high = ImGui::GetItemRectMax();
            if (f.changed()) { EXPECT_TRUE(document.apply(SetView{v}, f.gesture())); }
        });
    }
    void move(float x) {
        ImGui::GetIO().MousePos = {x, (low.y + high.y) / 2};
        frame();
    }
    void press(bool down) {
        ImGui::GetIO().MouseDown[0] = down;
        frame();
    }
    float middle() const { return (low.x + high.x) / 2; }
    // Long enough for the next press not to make a double-click with the last.
    void rest() {
        for (int i = 0; i < 60; ++i) frame();
    }
    void drag(float pixels) {
        rest();
        move(middle());
        press(true);
        for (int i = 1; i <= 5; ++i) move(middle() + pixels * float(i) / 5);
        press(false);
        frame();
    }
    float value() const { return document.project().view.exposure_ev; }

    Document document;
    UiState ui;
    NumberStyle style{.min = -10, .max = 10, .reset = 2.5f, .step = 0.01f};
    ImVec2 low, high;
};

// The window draws only the frames that somebody asks for.
TEST_F(Widgets, ATipAppearsOverAMouseAtRest) {
    constexpr double idle = 1;
    style.tip = "Stops of exposure.";
    ui.next_frame_in = idle;
    move(middle());
    for (int i = 0; i < 10 && ui.next_frame_in < idle; ++i) {
        ImGui::GetIO().DeltaTime = std::max(float(ui.next_frame_in), 1.f / 60);
        ui.next_frame_in = idle;
        frame();
    }
    EXPECT_EQ(ui.next_frame_in, idle) << "frames without end";
    const ImGuiWindow* tip = ImGui::FindWindowByName("##Tooltip_00");
    ASSERT_TRUE(tip);
    EXPECT_TRUE(tip->WasActive && !tip->Hidden);
}

TEST_F(Widgets, ATipWaitsForHalfASecondOfRest) {
    style.tip = "Stops of exposure.";
    const auto tip_shown = [] {
        const ImGuiWindow* tip = ImGui::FindWindowByName("##Tooltip_00");
        return tip && tip->WasActive && !tip->Hidden;
    };
    ImGui::GetIO().DeltaTime = 0.1f;
    move(middle());
    for (int i = 0; i < 4; ++i) {
        frame();
        EXPECT_FALSE(tip_shown()) << "after " << i + 1 << " tenths of a second";
    }
    for (int i = 0; i < 4; ++i) frame();
    EXPECT_TRUE(tip_shown());
    // The row below can be read and clicked.
    const ImGuiWindow* tip = ImGui::FindWindowByName("##Tooltip_00");
    const float row = high.y - low.y;
    EXPECT_TRUE(tip->Pos.x >= 400 || tip->Pos.y >= high.y + 2 * row || tip->Pos.y + tip->Size.y <= high.y) << tip->Pos.x << ", " << tip->Pos.y;
    press(true);
    for (int i = 0; i < 20; ++i) move(middle() + float(i % 3));
    for (int i = 0; i < 20; ++i) frame();
    EXPECT_FALSE(tip_shown()) << "while a drag goes on";
    press(false);
    frame();
    EXPECT_FALSE(tip_shown()) << "right after it";
}

TEST_F(Widgets, ADragIsOneStepAndTheNextDragAnother) {
    drag(60);
    const float first = value();
    EXPECT_GT(first, 0.3f);
    drag(-30);
    EXPECT_LT(value(), first);
    EXPECT_EQ(document.undo_labels().size(), 2u);
    ASSERT_TRUE(document.undo());
    EXPECT_EQ(value(), first);
}

TEST_F(Widgets, AClickAloneChangesNothing) {
    for (const bool bar : {false, true}) {
        style.bar = bar;
        drag(0);
        EXPECT_FALSE(document.can_undo());
    }
}

TEST_F(Widgets, TheEndOfABarFollowsTheMouse) {
    style.bar = true;
    drag((high.x - low.x) / 4);
    EXPECT_NEAR(value(), 5, 0.5); // a quarter of 20, less the threshold that tells a drag from a click
}

TEST_F(Widgets, ADoubleClickResets) {
    for (const bool bar : {false, true}) {
        style.bar = bar;
        drag(40);
        ASSERT_NE(value(), style.reset);
        rest();
        move(middle());
        for (const bool down : {true, false, true, false}) press(down);
        EXPECT_EQ(value(), style.reset);
    }
}

TEST_F(Widgets, LimitsHold) {
    style.step = 1;
    drag(200);
    EXPECT_EQ(value(), 10);
    drag(-500);
    EXPECT_EQ(value(), -10);
}

TEST_F(Widgets, TypedValuesAreTakenAndKeptWithinTheLimits) {
    ImGuiIO& io = ImGui::GetIO();
    constexpr int enter = 257;
    io.KeyMap[ImGuiKey_Enter] = enter;
    move(middle());
    io.KeyCtrl = true;
    press(true);
    press(false);
    io.KeyCtrl = false;
    frame();
    for (const char c : std::string("99")) io.AddInputCharacter(unsigned(c));
    frame();
    io.KeysDown[enter] = true;
    frame();
    io.KeysDown[enter] = false;
    frame();
    EXPECT_EQ(value(), 10);
    EXPECT_EQ(document.undo_labels().size(), 1u);
}

} // namespace
} // namespace blush
