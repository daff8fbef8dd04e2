// Modal dialog in the middle of the window.
#include "ui/panels/panels.h"
#include "ui/widgets/elided_text.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

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

// Tab and the arrow keys move the focus along the row, in which the first choice is the last button.
void move_focus(Question& question) {
    const auto pressed = [](int key) { return ImGui::IsKeyPressed(key); };
    const bool back = pressed(key::left) || (pressed(key::tab) && ImGui::GetIO().KeyShift);
    const bool forward = pressed(key::right) || (pressed(key::tab) && !ImGui::GetIO().KeyShift);
    const size_t count = question.choices.size();
    if (back) question.focused = (question.focused + 1) % count;
    if (forward) question.focused = (question.focused + count - 1) % count;
}

void choose_by_key(Question& question) {
    const auto pressed = [](int key) { return ImGui::IsKeyPressed(key, false); };
    if (pressed(key::escape)) question.chosen = question.choices.size() - 1;
    if (pressed(key::enter) || pressed(key::pad_enter) || pressed(key::space)) question.chosen = question.focused;
}

// Right-aligned. The first choice is the outermost, away from the others. File names may be shortened; the question has them.
void draw_choices(PanelContext& c, Question& question) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float em = ImGui::GetFontSize(), gap = style.ItemSpacing.x;
    std::vector<std::string> labels;
    std::vector<float> widths;
    for (const std::string& choice : question.choices) {
        labels.push_back(elided_middle(choice, 15 * em));
        widths.push_back(std::max(7 * em, ImGui::CalcTextSize(labels.back().c_str()).x + 2 * style.FramePadding.x));
    }
    const float all = std::accumulate(widths.begin(), widths.end(), gap * float(widths.size() - 1));
    ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), ImGui::GetWindowContentRegionMax().x - all));
    move_focus(question);
    for (size_t i = question.choices.size(); i-- > 0;) {
        if (ImGui::Button((labels[i] + "##" + question.choices[i]).c_str(), {widths[i], 0})) question.chosen = i;
        if (i == question.focused)
            ImGui::GetWindowDrawList()->AddRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), tone::text, style.FrameRounding);
        c.ui.probe.record_last_item("Question/" + question.choices[i]);
        if (i > 0) ImGui::SameLine();
    }
    choose_by_key(question);
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
    draw_texts(*c.ui.question);
    draw_choices(c, *c.ui.question);
    if (c.ui.question->chosen) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

} // namespace blush
