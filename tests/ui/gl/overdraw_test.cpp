// Overdraw reduction: draws rectangles in software, with and without it, and compares the pixels.
#include "tests/ui/imgui_test.h"
#include "ui/gl/overdraw.h"

#include <array>
#include <cmath>
#include <vector>

namespace blush::TEST_FILE {
namespace {

constexpr int width = 120, height = 90;

// The screen, and the number of pixels filled by clears and draws. All shapes here are rectangles on whole pixels.
struct Painted {
    std::vector<ImU32> pixels = std::vector<ImU32>(size_t(width) * height);
    int filled = 0, cleared = 0;

    int paint(const ImVec4& r, ImU32 color) {
        int count = 0;
        for (int y = std::max(int(r.y), 0); y < std::min(int(r.w), height); ++y)
            for (int x = std::max(int(r.x), 0); x < std::min(int(r.z), width); ++x, ++count) {
                ImU32& to = pixels[size_t(y) * width + size_t(x)];
                if (color >> IM_COL32_A_SHIFT == 255)
                    to = color;
                else
                    to = to * 31 + color; // a stand-in for blending: depends on the old value
            }
        return count;
    }
    explicit Painted(const ImDrawData& data) {
        for (int i = 0; i < data.CmdListsCount; ++i) {
            const ImDrawList& list = *data.CmdLists[i];
            for (const ImDrawCmd& command : list.CmdBuffer) {
                if (is_clearing(command)) cleared += paint(command.ClipRect, clearing_color(command));
                if (command.UserCallback) continue;
                for (unsigned e = 0; e + 5 < command.ElemCount; e += 6) {
                    const auto& at = [&](unsigned k) -> const ImDrawVert& {
                        return list.VtxBuffer[int(command.VtxOffset + list.IdxBuffer[int(command.IdxOffset + e + k)])];
                    };
                    const ImVec4 &c = command.ClipRect, r{std::max(at(0).pos.x, c.x), std::max(at(0).pos.y, c.y),
                                                          std::min(at(2).pos.x, c.z), std::min(at(2).pos.y, c.w)};
                    filled += paint(r, at(0).col);
                }
            }
        }
    }
};

class Overdraw : public test::ImGuiTest {
protected:
    void SetUp() override {
        ImGuiTest::SetUp();
        ImGui::NewFrame();
        lists_.resize(3, nullptr);
        for (ImDrawList*& list : lists_) {
            list = IM_NEW(ImDrawList)(ImGui::GetDrawListSharedData());
            list->_ResetForNewFrame();
            list->PushClipRect({0, 0}, {width, height});
            list->PushTextureID(ImGui::GetIO().Fonts->TexID);
        }
    }
    void TearDown() override {
        for (ImDrawList* list : lists_) IM_DELETE(list);
        ImGui::EndFrame();
        ImGuiTest::TearDown();
    }
    ImDrawList& list(size_t i) { return *lists_[i]; }
    // Pixels filled before and after.
    std::array<Painted, 2> spared() {
        ImDrawData data;
        data.CmdLists = lists_.data();
        data.CmdListsCount = int(lists_.size());
        const Painted before(data);
        reduce_overdraw(data);
        return {before, Painted(data)};
    }

private:
    std::vector<ImDrawList*> lists_;
};

constexpr ImU32 grey = IM_COL32(60, 60, 60, 255), red = IM_COL32(200, 0, 0, 255), veil = IM_COL32(0, 90, 0, 100);

TEST_F(Overdraw, BackgroundsAreClearedAndCoveredDrawsSkipped) {
    list(0).AddRectFilled({0, 0}, {width, height}, red); // an image, say
    list(0).AddRectFilled({5, 5}, {50, 50}, veil);
    list(1).AddRectFilled({20, 10}, {80, 60}, grey);
    list(1).AddRectFilled({25, 15}, {40, 20}, veil);
    list(2).AddRectFilled({60, 30}, {110, 85}, grey);
    const auto [before, after] = spared();
    EXPECT_EQ(after.pixels, before.pixels);
    EXPECT_EQ(after.cleared, width * height) << "each pixel once: the backgrounds cover everything";
    EXPECT_EQ(after.filled, 45 * 45 - 30 * 40 + 15 * 5) << "the transparent rectangles, where visible";
}

TEST_F(Overdraw, TransparentRectanglesCoverNothing) {
    list(0).AddRectFilled({3, 3}, {90, 70}, veil);
    list(1).AddRectFilled({20, 10}, {80, 60}, veil);
    list(2).AddRectFilled({10.5f, 10}, {80, 60}, grey); // not on whole pixels
    const auto [before, after] = spared();
    EXPECT_EQ(after.pixels, before.pixels);
    EXPECT_EQ(after.filled, before.filled);
    EXPECT_EQ(after.cleared, 0);
}

TEST_F(Overdraw, LargeCommandsAreDrawnOnceUnlessCovered) {
    for (int i = 0; i < 20; ++i) list(0).AddRectFilled({float(i), 0}, {float(i) + 30, 30}, veil);
    list(1).AddRectFilled({5, 5}, {15, 15}, grey);
    list(2).AddRectFilled({0, 0}, {10, 10}, grey);
    EXPECT_EQ(list(0).CmdBuffer.Size, 1);
    const auto [before, after] = spared();
    EXPECT_EQ(after.pixels, before.pixels);
    EXPECT_EQ(after.filled, before.filled - 200);
    EXPECT_EQ(list(0).CmdBuffer.Size, 1);
}

TEST_F(Overdraw, CoveredListsDrawNothing) {
    for (int i = 0; i < 20; ++i) list(0).AddRectFilled({float(i) + 30, 30}, {float(i) + 40, 50}, veil);
    list(0).CmdBuffer[0].ClipRect = {30, 30, 60, 50};
    list(1).AddRectFilled({20, 20}, {70, 60}, grey);
    list(2).AddRectFilled({0, 0}, {10, 10}, veil);
    const auto [before, after] = spared();
    EXPECT_EQ(after.pixels, before.pixels);
    EXPECT_EQ(after.filled, 100);
}

// Callbacks keep their order.
TEST_F(Overdraw, CallbacksStay) {
    const auto nothing = [](const ImDrawList*, const ImDrawCmd*) {};
    list(0).AddRectFilled({0, 0}, {50, 50}, grey);
    list(0).AddCallback(nothing, nullptr);
    list(0).AddRectFilled({0, 0}, {20, 20}, veil);
    list(1).AddRectFilled({0, 0}, {width, height}, grey);
    list(2).AddRectFilled({0, 0}, {10, 10}, veil);
    spared();
    ASSERT_EQ(list(0).CmdBuffer.Size, 1) << "everything else is covered";
    EXPECT_TRUE(list(0).CmdBuffer[0].UserCallback);
    EXPECT_FALSE(is_clearing(list(0).CmdBuffer[0]));
}

} // namespace
} // namespace blush::TEST_FILE
