// The timeline.
#include "tests/support/sample_project.h"
#include "tests/ui/imgui_test.h"
#include "tests/ui/shipped_ocio_config.h"
#include "ui/panels/panels.h"

namespace blush::TEST_FILE {
namespace {

class Time : public test::ImGuiTest {
protected:
    void SetUp() override {
        ImGuiTest::SetUp();
        document.reset(sample.project);
        ASSERT_TRUE(document.apply(SetSceneSelection{{.clip = sample.swing}}));
        for (int i = 0; i < 3; ++i) frame();
    }
    void frame() {
        in_window([&] {
            ui.seconds_to_next_frame = 1;
            PanelContext c{document, ui, color, {}, SessionStatus(), 640, 480};
            draw_time(c);
        });
    }
    void mouse(float x, bool down) {
        ImGui::GetIO().MousePos = {x, ImGui::GetStyle().WindowPadding.y + 8};
        ImGui::GetIO().MouseDown[0] = down;
        frame();
    }
    float seconds() const { return document.project().scene.scene_selection.seconds; }

    test::Sample sample = test::sample_project();
    const ColorManagement color = test::our_colors();
    Document document;
    UiState ui;
};

TEST_F(Time, SliderDragIsOneUndoStep) {
    const size_t steps = document.undo_labels().size();
    mouse(220, false);
    mouse(220, true);
    float before = seconds();
    for (const float x : {240.f, 260.f, 280.f}) {
        mouse(x, true);
        EXPECT_GT(seconds(), before) << x;
        before = seconds();
    }
    mouse(280, false);
    frame();
    EXPECT_EQ(document.undo_labels().size(), steps + 1);
    EXPECT_EQ(document.undo_label(), "Change time");
    mouse(240, false);
    mouse(240, true);
    mouse(240, false);
    frame();
    EXPECT_LT(seconds(), before);
    EXPECT_EQ(document.undo_labels().size(), steps + 2) << "another drag, another step";
}

TEST_F(Time, PlaybackLoopsAndIsOneUndoStep) {
    const size_t steps = document.undo_labels().size();
    ui.time = {.playing = true, .gesture = ui.gestures.begin()};
    ui.gestures.end();
    ImGui::GetIO().DeltaTime = 0.75f;
    for (const float t : {0.75f, 1.5f, 0.25f}) {
        frame();
        EXPECT_FLOAT_EQ(seconds(), t) << "of 2 s";
        EXPECT_LT(ui.seconds_to_next_frame, 0.1) << "the next frame is requested";
    }
    EXPECT_EQ(document.undo_labels().size(), steps + 1);
    ui.time = {};
    frame();
    EXPECT_EQ(seconds(), 0.25f);
    EXPECT_EQ(ui.seconds_to_next_frame, 1) << "playback has stopped";
}

TEST_F(Time, RestPoseCannotBePlayed) {
    ui.time.playing = true;
    ASSERT_TRUE(document.apply(SetSceneSelection{}));
    frame();
    EXPECT_FALSE(ui.time.playing);
    EXPECT_EQ(ui.seconds_to_next_frame, 1);
}

} // namespace
} // namespace blush::TEST_FILE
