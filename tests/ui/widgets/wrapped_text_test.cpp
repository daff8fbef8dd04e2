// Paragraphs break between words only.
#include "tests/ui/imgui_test.h"
#include "ui/widgets/wrapped_text.h"

#include <sstream>

namespace blush::TEST_FILE {
namespace {

float width_of(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }

using WrappedText = test::ImGuiFrameTest;

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

TEST_F(WrappedText, BreaksAtSpacesAlone) {
    const std::string text = "Noise of the mix: RMSE 0.0505, 95 % interval 0.0431 to 0.0589.";
    for (float width = width_of("0.0505,"); width < width_of(text) + 10; ++width) {
        std::string joined = wrapped(text, width);
        for (const std::string& line : lines_of(joined))
            EXPECT_TRUE(line.find(' ') == std::string::npos || width_of(line) <= width) << line;
        for (char& c : joined)
            if (c == '\n') c = ' ';
        EXPECT_EQ(joined, text);
    }
    EXPECT_EQ(wrapped(text, width_of(text)), text);
}

TEST_F(WrappedText, KeepsLineBreaksAndFillsLines) {
    EXPECT_EQ(wrapped("", 100), "");
    EXPECT_EQ(wrapped("a\nb", 1000), "a\nb");
    EXPECT_EQ(wrapped("one two three", width_of("one two")), "one two\nthree");
    EXPECT_EQ(wrapped("x\none two three", width_of("one two")), "x\none two\nthree");
    EXPECT_EQ(wrapped("a longest b", width_of("a b")), "a\nlongest\nb");
}

} // namespace
} // namespace blush::TEST_FILE
