// ImGui without a window: draws panels and drags widgets with a simulated mouse.
#pragma once

#include <gtest/gtest.h>
#include <imgui.h>

namespace blush::test {

class ImGuiTest : public testing::Test {
protected:
    void SetUp() override {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {1280, 2000};
        io.DeltaTime = 1.f / 60;
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    }
    void TearDown() override { ImGui::DestroyContext(); }

    // One frame; `draw` fills a window.
    template <class Draw> void in_window(const Draw& draw) {
        ImGui::NewFrame();
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({400, 2000});
        ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration);
        draw();
        ImGui::End();
        ImGui::EndFrame();
    }
};

// Within one frame.
class ImGuiFrameTest : public ImGuiTest {
protected:
    void SetUp() override {
        ImGuiTest::SetUp();
        ImGui::NewFrame();
    }
    void TearDown() override {
        ImGui::EndFrame();
        ImGuiTest::TearDown();
    }
};

} // namespace blush::test
