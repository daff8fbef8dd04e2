// Text that is shortened to its place.
#include "tests/ui/imgui_test.h"
#include "ui/widgets/elided_text.h"

namespace blush::TEST_FILE {
namespace {

float width_of(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }

using ElidedText = test::ImGuiFrameTest;

TEST_F(ElidedText, KeepsTextThatFits) {
    EXPECT_EQ(elided("card", width_of("card")), "card");
    EXPECT_EQ(elided_middle("card", width_of("card")), "card");
}

TEST_F(ElidedText, ALongTextLosesItsEndAndAPathItsMiddle) {
    const std::string path = "/home/somebody/scenes/kitchen/kitchen_with_two_lamps.gltf";
    for (float width = width_of("…ab"); width < width_of(path); width += 3) {
        const std::string end = elided(path, width), middle = elided_middle(path, width);
        for (const std::string& shown : {end, middle}) {
            EXPECT_LE(width_of(shown), width + 1) << shown; // widths are rounded to pixels
            EXPECT_NE(shown.find("…"), std::string::npos) << shown;
        }
        EXPECT_EQ(end.substr(0, end.find("…")), path.substr(0, end.find("…")));
        const std::string tail = middle.substr(middle.find("…") + 3);
        EXPECT_EQ(path.substr(path.size() - tail.size()), tail);
    }
    const std::string shown = elided_middle(path, width_of(path) * 0.6f);
    EXPECT_EQ(shown.rfind("/home/", 0), 0u) << shown;
    EXPECT_NE(shown.find("lamps.gltf"), std::string::npos) << shown;
}

TEST_F(ElidedText, DoesNotSplitCharacters) {
    const std::string text = "ÄÖÜäöüßÄÖÜäöüß";
    for (float width = width_of("…"); width < width_of(text); ++width)
        for (const std::string& shown : {elided(text, width), elided_middle(text, width)}) {
            const size_t dots = shown.find("…");
            ASSERT_NE(dots, std::string::npos);
            EXPECT_EQ(dots % 2, 0u) << shown;
            EXPECT_EQ((shown.size() - dots - 3) % 2, 0u) << shown;
        }
}

} // namespace
} // namespace blush::TEST_FILE
