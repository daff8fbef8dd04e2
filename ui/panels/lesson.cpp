// The panel of a lesson: one step in large type, with Back and Next. Its requests go to the editor.
#include "ui/panels/panels.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/wrapped_text.h"
#include "ui/window/theme.h"

#include <fmt/format.h>

namespace blush {
namespace {

constexpr float title_scale = 1.6f, text_scale = 1.25f; // of the size of other panels

void draw_text(const std::string& markdown) {
    for (const std::string& paragraph : paragraphs_of(markdown)) {
        wrapped_text(paragraph);
        ImGui::Spacing();
    }
}

bool button(PanelContext& c, const char* name, bool enabled) {
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(name);
    ImGui::EndDisabled();
    c.ui.probe.record_last_item(std::string("Lesson/") + name);
    return pressed && enabled;
}

void draw_question(PanelContext& c, LessonView& view, const LessonView::Step& step) {
    if (step.question.empty()) return;
    ImGui::Separator();
    ImGui::Spacing();
    wrapped_text(step.question);
    if (step.expect.empty()) return;
    if (view.answer) {
        ImGui::PushStyleColor(ImGuiCol_Text, tone::dim_text);
        wrapped_text(step.expect);
        ImGui::PopStyleColor();
    } else if (button(c, "Show the answer", true)) {
        view.answer = true;
    }
}

} // namespace

void draw_lesson_panel(PanelContext& c) {
    LessonView& view = c.ui.lesson;
    if (!view.is_on()) return;
    const LessonView::Step& step = view.steps[view.step];
    const float buttons = ImGui::GetFrameHeightWithSpacing() * text_scale;
    ImGui::BeginChild("step", {0, -buttons});
    ImGui::SetWindowFontScale(1);
    ImGui::PushStyleColor(ImGuiCol_Text, tone::dim_text);
    wrapped_text(fmt::format("{}, step {} of {}", view.title, view.step + 1, view.steps.size()));
    c.ui.probe.record_last_item(fmt::format("Lesson/Step {}", view.step + 1));
    ImGui::PopStyleColor();
    ImGui::SetWindowFontScale(title_scale);
    wrapped_text(step.title);
    ImGui::SetWindowFontScale(text_scale);
    ImGui::Spacing();
    draw_text(step.text);
    draw_question(c, view, step);
    ImGui::EndChild();
    ImGui::SetWindowFontScale(text_scale);
    if (button(c, "Back", view.step > 0)) view.to_step = view.step - 1;
    ImGui::SameLine();
    if (button(c, "Next", view.step + 1 < view.steps.size())) view.to_step = view.step + 1;
    ImGui::SameLine();
    if (button(c, "Reset step", true)) view.to_step = view.step;
    tip_for_last_item(c.ui, "Set scene, settings and panels of this step again.");
    ImGui::SameLine();
    if (button(c, "End lesson", true)) view.to_end = true;
    tip_for_last_item(c.ui, "Back to your own scene, as it was before the lesson.");
    ImGui::SetWindowFontScale(1);
}

} // namespace blush
