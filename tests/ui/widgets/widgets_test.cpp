// Value fields with simulated mouse and keyboard, without a window.
#include "tests/ui/imgui_test.h"
#include "ui/widgets/value_menu.h"
#include "ui/widgets/widgets.h"
#include "ui/widgets/wrapped_text.h"
#include "ui/window/imgui_state.h"

#include <imgui_internal.h>

namespace blush::TEST_FILE {
namespace {

class Widgets : public test::ImGuiTest {
protected:
    void SetUp() override {
        ImGuiTest::SetUp();
        frame(); // ImGui computes a window's layout in its first frame
        frame();
    }

    // One frame of a panel that edits the exposure.
    void frame() {
        in_window([&] {
            ViewSettings v = document.project().view;
            Fields f(ui, "Panel");
            f.number("Exposure", v.exposure_ev, style);
            low = ImGui::GetItemRectMin();
            high = ImGui::GetItemRectMax();
            if (second) f.number("Gamma", v.gamma, style);
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
    void type(const std::string& text) {
        frame();
        for (const char c : text) ImGui::GetIO().AddInputCharacter(unsigned(c));
        frame();
    }
    void enter() {
        constexpr int key = 257;
        ImGuiIO& io = ImGui::GetIO();
        io.KeyMap[ImGuiKey_Enter] = key;
        io.KeysDown[key] = true;
        frame();
        io.KeysDown[key] = false;
        frame();
    }
    void request(ValueAction what) {
        request_value_action(ui, what);
        frame();
    }
    float middle() const { return (low.x + high.x) / 2; }
    // Waits, so that the next press is not a double-click.
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
    bool second = false; // a field below the first
};

class ColorField : public test::ImGuiTest {
protected:
    void SetUp() override {
        ImGuiTest::SetUp();
        for (int i = 0; i < 3; ++i) frame();
        ImGui::GetIO().MousePos = {swatch.x, swatch.y};
        frame();
    }
    void frame() {
        in_window([&] {
            Fields f(ui, "Panel");
            const ImVec2 at = ImGui::GetCursorScreenPos();
            f.color("Tint", value, {1, 1, 1}, "");
            swatch = {at.x + 400 * 0.4f + 12, at.y + ImGui::GetFrameHeight() / 2};
            changed |= f.changed();
        });
    }
    void request(ValueAction what) {
        changed = false;
        request_value_action(ui, what);
        frame();
    }
    void paste(const char* text) {
        ImGui::SetClipboardText(text);
        request(ValueAction::paste);
    }

    UiState ui;
    Vec3 value{0.25f, 0.5f, 0.0625f};
    ImVec2 swatch;
    bool changed = false;
};

TEST_F(ColorField, AcceptsEachColourFormat) {
    request(ValueAction::copy_hex);
    EXPECT_STREQ(ImGui::GetClipboardText(), "#89bc47");
    paste("#ff0080");
    EXPECT_TRUE(changed);
    EXPECT_NEAR(value.x, 1, 1e-6);
    EXPECT_EQ(value.y, 0);
    EXPECT_NEAR(value.z, 0.2158605f, 1e-5);
    value = {0.25f, 0.5f, 0.0625f};
    request(ValueAction::copy);
    EXPECT_STREQ(ImGui::GetClipboardText(), "0.25, 0.5, 0.0625");
    request(ValueAction::copy_srgb);
    value = {0, 0, 0};
    request(ValueAction::paste);
    EXPECT_NEAR(value.x, 0.25, 1e-5);
    EXPECT_NEAR(value.z, 0.0625, 1e-5);
}

TEST_F(ColorField, RejectsInvalidColours) {
    const Vec3 before = value;
    for (const char* text :
         {"", "#12345", "#gggggg", "red", "1, 2", "1, 2, 3, 4", "-1, 0, 0", "nan, 0, 0", "1e30, 0, 0", "srgb(", "(((1,1,1)))"}) {
        const auto said = ui.toasts.added();
        paste(text);
        EXPECT_EQ(value, before) << text;
        EXPECT_FALSE(changed) << text;
        EXPECT_GT(ui.toasts.added(), said) << text;
    }
}

TEST_F(ColorField, EyedropperSetsThePickedColour) {
    request(ValueAction::pick);
    EXPECT_EQ(ui.tool, ViewTool::pick_color);
    ui.values.picked = Vec3{0.1f, 7.f, -0.5f};
    changed = false;
    frame();
    EXPECT_TRUE(changed);
    EXPECT_EQ(value, (Vec3{0.1f, 7.f, 0.f})) << "scene-linear, not negative";
    changed = false;
    frame();
    EXPECT_FALSE(changed) << "once";
}

// The window only draws requested frames.
TEST_F(Widgets, OnlyADragOfTheNumberWrapsTheCursor) {
    move(middle());
    EXPECT_FALSE(ui.wraps_cursor);
    press(true);
    EXPECT_FALSE(ui.wraps_cursor) << "a click";
    move(middle() + 30);
    EXPECT_TRUE(ui.wraps_cursor);
    press(false);
    ui.wraps_cursor = false; // as the editor does in each frame
    frame();
    EXPECT_FALSE(ui.wraps_cursor) << "released";
    rest();
    for (const bool down : {true, false, true}) press(down); // the second click starts typing
    type("1");
    move(middle() + 60);
    EXPECT_FALSE(ui.wraps_cursor) << "text is selected by the mouse";
    press(false);
}

TEST_F(Widgets, TooltipAppearsAtRest) {
    constexpr double idle = 1;
    style.tip = "Stops of exposure.";
    ui.seconds_to_next_frame = idle;
    move(middle());
    for (int i = 0; i < 10 && (ui.seconds_to_next_frame < idle || needs_another_frame()); ++i) {
        ImGui::GetIO().DeltaTime = std::max(float(ui.seconds_to_next_frame), 1.f / 60);
        ui.seconds_to_next_frame = idle;
        frame();
    }
    EXPECT_EQ(ui.seconds_to_next_frame, idle) << "endless frames";
    const ImGuiWindow* tip = ImGui::FindWindowByName("##Tooltip_00");
    ASSERT_TRUE(tip);
    EXPECT_TRUE(tip->WasActive && !tip->Hidden);
}

TEST_F(Widgets, TooltipBreaksItsLinesOnce) {
    ImGui::GetIO().DeltaTime = 0.1f;
    for (size_t first = 1; first < 30; ++first) { // its first line ends anywhere
        std::string text(first, 'i');
        for (int i = 0; i < 30; ++i) text += " word";
        style.tip = text.c_str();
        rest();
        move(middle());
        for (int i = 0; i < 10; ++i) frame();
        const ImGuiWindow* tip = ImGui::FindWindowByName("##Tooltip_00");
        ASSERT_TRUE(tip && tip->WasActive && !tip->Hidden) << first;
        const std::string lines = wrapped(text, ImGui::GetFontSize() * 24);
        const auto count = 1 + std::ranges::count(lines, '\n');
        EXPECT_NEAR(tip->Size.y - 2 * ImGui::GetStyle().WindowPadding.y, float(count) * ImGui::GetTextLineHeight(), 1) << lines;
    }
}

TEST_F(Widgets, TooltipHasADelayOfHalfASecond) {
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
    // The row below stays readable and clickable.
    const ImGuiWindow* tip = ImGui::FindWindowByName("##Tooltip_00");
    const float row = high.y - low.y;
    EXPECT_TRUE(tip->Pos.x >= 400 || tip->Pos.y >= high.y + 2 * row || tip->Pos.y + tip->Size.y <= high.y)
        << tip->Pos.x << ", " << tip->Pos.y;
    press(true);
    for (int i = 0; i < 20; ++i) move(middle() + float(i % 3));
    for (int i = 0; i < 20; ++i) frame();
    EXPECT_FALSE(tip_shown()) << "during a drag";
    press(false);
    frame();
    EXPECT_FALSE(tip_shown()) << "right after it";
}

TEST_F(Widgets, EachDragIsOneUndoStep) {
    drag(60);
    const float first = value();
    EXPECT_GT(first, 0.3f);
    drag(-30);
    EXPECT_LT(value(), first);
    EXPECT_EQ(document.undo_labels().size(), 2u);
    ASSERT_TRUE(document.undo());
    EXPECT_EQ(value(), first);
}

TEST_F(Widgets, ClickWithoutDragChangesNothing) {
    for (const bool bar : {false, true}) {
        style.bar = bar;
        drag(0);
        EXPECT_FALSE(document.can_undo());
    }
}

TEST_F(Widgets, BarFollowsTheMouse) {
    style.bar = true;
    drag((high.x - low.x) / 4);
    EXPECT_NEAR(value(), 5, 0.5); // a quarter of 20, minus ImGui's drag threshold
}

TEST_F(Widgets, ShiftDragsTenTimesFiner) {
    for (const bool bar : {false, true}) {
        style.bar = bar;
        ASSERT_TRUE(document.apply(SetView{}));
        const float before = value();
        drag(60);
        const float full = value() - before;
        ImGui::GetIO().KeyShift = true;
        drag(60);
        ImGui::GetIO().KeyShift = false;
        EXPECT_NEAR(value() - before - full, full / 10, std::abs(full) / 50);
    }
}

TEST_F(Widgets, DoubleClickStartsTyping) {
    for (const bool bar : {false, true}) {
        style.bar = bar;
        rest();
        move(middle());
        for (const bool down : {true, false, true, false}) press(down);
        type(bar ? "3.5" : "2.25");
        enter();
        EXPECT_EQ(value(), bar ? 3.5f : 2.25f);
    }
    EXPECT_EQ(document.undo_labels().size(), 2u);
}

TEST_F(Widgets, FractionsAreTypedAsShown) {
    style = {.min = 1e-9f, .max = 1e9f, .unit = "s", .fraction = true};
    const auto type_in = [&](const std::string& text) {
        rest();
        move(middle());
        for (const bool down : {true, false, true, false}) press(down);
        type(text);
        enter();
    };
    type_in("1/125");
    EXPECT_EQ(value(), 1 / 125.f);
    type_in("2.5");
    EXPECT_EQ(value(), 2.5f) << "seconds";
    type_in("0.004");
    EXPECT_EQ(value(), 0.004f);
    for (const char* incomplete : {"1/", "1/0", "/"}) type_in(incomplete);
    EXPECT_EQ(value(), 0.004f);
    EXPECT_EQ(document.undo_labels().size(), 3u) << "each is one undo step";
    style.step = 0.005f;
    drag(60);
    EXPECT_NEAR(value(), 0.304f, 1e-5) << "dragged without being rounded to its digits";
}

TEST_F(Widgets, TabMovesToTheNextField) {
    constexpr int tab = 258;
    ImGui::GetIO().KeyMap[ImGuiKey_Tab] = tab;
    second = true;
    frame();
    move(middle());
    for (const bool down : {true, false, true, false}) press(down);
    type("1.5");
    ImGui::GetIO().KeysDown[tab] = true;
    frame();
    ImGui::GetIO().KeysDown[tab] = false;
    for (int i = 0; i < 4; ++i) frame();
    type("2.5");
    enter();
    EXPECT_EQ(value(), 1.5f);
    EXPECT_EQ(document.project().view.gamma, 2.5f);
    EXPECT_EQ(document.undo_labels().size(), 2u);
}

TEST_F(Widgets, KeysOverAFieldCopyPasteAndReset) {
    ASSERT_TRUE(document.apply(SetView{{.exposure_ev = 1.2345678f}}));
    move(middle());
    request(ValueAction::copy);
    EXPECT_STREQ(ImGui::GetClipboardText(), "1.2345678");
    request(ValueAction::reset);
    EXPECT_EQ(value(), 2.5f);
    request(ValueAction::paste);
    EXPECT_EQ(value(), 1.2345678f);
    ImGui::SetClipboardText(" -1e30\n");
    request(ValueAction::paste);
    EXPECT_EQ(value(), -10) << "within the limits";
    EXPECT_EQ(document.undo_labels().size(), 4u) << "each is its own undo step";
    rest();
    move(-100);
    ImGui::SetClipboardText("3");
    request(ValueAction::paste);
    EXPECT_EQ(value(), -10) << "the mouse is elsewhere";
}

TEST_F(Widgets, InvalidNumbersAreRejected) {
    move(middle());
    const std::string huge(100000, '9');
    for (const char* text : {"", "nan", "inf", "1e999", "two", "1 2", "#ff0000", "%s%n%s%n", "\x01\x02\xff", "--1", huge.c_str()}) {
        ImGui::SetClipboardText(text);
        const float before = value();
        const auto said = ui.toasts.added();
        request(ValueAction::paste);
        EXPECT_EQ(value(), before) << text;
        EXPECT_GT(ui.toasts.added(), said) << text;
        for (const char c : ui.toasts.all().back().text) EXPECT_TRUE(c >= ' ' && c < 127) << text;
        EXPECT_LT(ui.toasts.all().back().text.size(), 120u);
    }
    EXPECT_FALSE(document.can_undo());
}

TEST_F(Widgets, LimitsApply) {
    style.step = 1;
    drag(200);
    EXPECT_EQ(value(), 10);
    drag(-500);
    EXPECT_EQ(value(), -10);
}

TEST_F(Widgets, TypedValuesAreClamped) {
    ImGuiIO& io = ImGui::GetIO();
    move(middle());
    io.KeyCtrl = true;
    press(true);
    press(false);
    io.KeyCtrl = false;
    type("99");
    enter();
    EXPECT_EQ(value(), 10);
    EXPECT_EQ(document.undo_labels().size(), 1u);
}

} // namespace
} // namespace blush::TEST_FILE
