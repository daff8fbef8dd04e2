// What a frame leaves to the next one: ImGui without a window.
#include "tests/ui/imgui_test.h"
#include "ui/window/imgui_state.h"

#include <array>
#include <imgui_internal.h> // the scrolling of a row of tabs
#include <string>
#include <utility>

namespace blush::TEST_FILE {
namespace {

class ImGuiState : public test::ImGuiTest {
protected:
    // Frames until nothing is left to the next one.
    template <class Draw> int frames_to_settle(const Draw& draw) {
        for (int frames = 1; frames < 10; ++frames) {
            in_window(draw);
            if (!needs_another_frame()) return frames;
        }
        return 10;
    }
};

TEST_F(ImGuiState, NothingIsLeftByAnUnchangedPanel) {
    const auto draw = [] { ImGui::Button("OK"); };
    frames_to_settle(draw);
    EXPECT_EQ(frames_to_settle(draw), 1);
}

TEST_F(ImGuiState, PopupIsShownInTheFrameAfterItsMeasurement) {
    bool opens = true;
    const auto draw = [&] {
        if (std::exchange(opens, false)) ImGui::OpenPopup("menu");
        if (!ImGui::BeginPopup("menu")) return;
        ImGui::TextUnformatted("Save");
        ImGui::EndPopup();
    };
    frames_to_settle([] {});
    EXPECT_EQ(frames_to_settle(draw), 2);
    EXPECT_EQ(frames_to_settle(draw), 1);
}

TEST_F(ImGuiState, FieldGetsTheKeyboardThatItIsGiven) {
    std::array<char, 16> text{};
    bool asks = true;
    const auto draw = [&] {
        if (std::exchange(asks, false)) ImGui::SetKeyboardFocusHere();
        ImGui::InputText("path", text.data(), text.size());
    };
    frames_to_settle([] {});
    EXPECT_GT(frames_to_settle(draw), 1);
    EXPECT_TRUE(ImGui::GetIO().WantTextInput);
    frames_to_settle([] {});
    EXPECT_FALSE(ImGui::GetIO().WantTextInput) << "the field is gone";
}

TEST_F(ImGuiState, RowOfTabsScrollsToItsEnd) {
    const ImGuiTabBar* bar = nullptr;
    bool to_last = false;
    const auto draw = [&] {
        if (!ImGui::BeginTabBar("tabs", ImGuiTabBarFlags_FittingPolicyScroll)) return;
        bar = ImGui::GetCurrentContext()->CurrentTabBar;
        for (int i = 0; i < 5; ++i)
            if (ImGui::BeginTabItem(("Instrument " + std::to_string(i)).c_str(), nullptr,
                                    i == 4 && to_last ? ImGuiTabItemFlags_SetSelected : 0))
                ImGui::EndTabItem();
        ImGui::EndTabBar();
    };
    frames_to_settle(draw);
    to_last = true;
    for (int i = 0; i < 3; ++i) in_window(draw); // as after input
    to_last = false;
    for (int i = 0; i < 100 && needs_another_frame(); ++i) in_window(draw);
    ASSERT_TRUE(bar);
    EXPECT_GT(bar->ScrollingTarget, 0);
    EXPECT_EQ(bar->ScrollingAnim, bar->ScrollingTarget);
}

} // namespace
} // namespace blush::TEST_FILE
