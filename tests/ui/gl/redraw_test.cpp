// Which UI frames have to be drawn again: panels drawn by ImGui without a window.
#include "tests/ui/imgui_test.h"
#include "ui/gl/redraw.h"

namespace blush::TEST_FILE {
namespace {

class RedrawTest : public test::ImGuiTest {
protected:
    bool is_needed(const char* text, ImTextureID image = ImGui::GetIO().Fonts->TexID) {
        in_window([&] {
            ImGui::TextUnformatted(text);
            ImGui::Image(image, {40, 40});
        });
        ImGui::Render();
        return redraw_.is_needed(*ImGui::GetDrawData());
    }
    void settle() {
        for (int frame = 0; frame < 3; ++frame) is_needed("12 spp"); // ImGui measures windows in their first frames
    }
    Redraw redraw_;
};

TEST_F(RedrawTest, FramesThatLookTheSameAreDrawnOnce) {
    EXPECT_TRUE(is_needed("12 spp"));
    settle();
    EXPECT_FALSE(is_needed("12 spp"));
    EXPECT_TRUE(is_needed("13 spp"));
    EXPECT_FALSE(is_needed("13 spp"));
}

TEST_F(RedrawTest, AnotherTextureIsDrawn) {
    settle();
    const auto other = reinterpret_cast<ImTextureID>(7);
    EXPECT_TRUE(is_needed("12 spp", other));
    EXPECT_FALSE(is_needed("12 spp", other));
}

TEST_F(RedrawTest, NewContentUnderTheSameNameIsDrawn) {
    settle();
    textures_changed();
    EXPECT_TRUE(is_needed("12 spp"));
    EXPECT_FALSE(is_needed("12 spp"));
}

TEST_F(RedrawTest, LostContentIsDrawnAgain) {
    settle();
    redraw_.force();
    EXPECT_TRUE(is_needed("12 spp"));
    EXPECT_FALSE(is_needed("12 spp"));
}

} // namespace
} // namespace blush::TEST_FILE
