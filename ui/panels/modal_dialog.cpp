// Modal dialog in the middle of the window.
#include "ui/panels/panels.h"
#include "ui/window/theme.h"

#include <algorithm>

namespace blush {
namespace {

void draw_texts(const Question& question) {
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 30);
    ImGui::TextUnformatted(question.text.c_str());
    if (!question.details.empty()) {
        ImGui::Spacing();
        ImGui::PushStyleColor(ImGuiCol_Text, tone::dim_text);
        ImGui::TextUnformatted(question.details.c_str());
        ImGui::PopStyleColor();
    }
    ImGui::PopTextWrapPos();
    ImGui::Spacing();
    ImGui::Spacing();
}

// Right-aligned. The first choice is the outermost, away from the others.
void draw_choices(PanelContext& c, Question& question) {
    const float width = ImGui::GetFontSize() * 7, gap = ImGui::GetStyle().ItemSpacing.x;
    const float all = float(question.choices.size()) * (width + gap) - gap;
    ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), ImGui::GetWindowContentRegionMax().x - all));
    for (size_t i = question.choices.size(); i-- > 0;) {
        if (ImGui::Button(question.choices[i].c_str(), {width, 0})) question.chosen = i;
        c.ui.probe.record_last_item("Question/" + question.choices[i]);
        if (i == 0) ImGui::SetItemDefaultFocus();
        if (i > 0) ImGui::SameLine();
    }
    if (ImGui::IsKeyPressed(key::escape)) question.chosen = question.choices.size() - 1;
    if (ImGui::IsKeyPressed(key::enter)) question.chosen = 0;
}

} // namespace

void draw_question(PanelContext& c) {
    if (!c.ui.question) return;
    constexpr const char* name = "Blush###question";
    if (!ImGui::IsPopupOpen(name)) ImGui::OpenPopup(name);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(name, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoTitleBar))
        return;
    if (ImGui::IsWindowAppearing()) c.ui.seconds_to_next_frame = 0; // becomes visible in the frame after the one that measures its size
    draw_texts(*c.ui.question);
    draw_choices(c, *c.ui.question);
    if (c.ui.question->chosen) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

} // namespace blush
