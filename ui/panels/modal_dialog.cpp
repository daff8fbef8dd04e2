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

void draw_texts(const ModalDialog& dialog) {
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 30);
    ImGui::TextUnformatted(dialog.text.c_str());
    if (!dialog.details.empty()) {
        ImGui::Spacing();
        ImGui::PushStyleColor(ImGuiCol_Text, tone::dim_text);
        ImGui::TextUnformatted(dialog.details.c_str());
        ImGui::PopStyleColor();
    }
    ImGui::PopTextWrapPos();
    ImGui::Spacing();
    ImGui::Spacing();
}

// Tab and the arrow keys move the focus along the row, in which the first choice is the last button.
void move_focus(ModalDialog& dialog) {
    const auto pressed = [](int key) { return ImGui::IsKeyPressed(key); };
    const bool back = pressed(key::left) || (pressed(key::tab) && ImGui::GetIO().KeyShift);
    const bool forward = pressed(key::right) || (pressed(key::tab) && !ImGui::GetIO().KeyShift);
    const size_t count = dialog.choices.size();
    if (back) dialog.focused = (dialog.focused + 1) % count;
    if (forward) dialog.focused = (dialog.focused + count - 1) % count;
}

void choose_by_key(ModalDialog& dialog) {
    const auto pressed = [](int key) { return ImGui::IsKeyPressed(key, false); };
    if (pressed(key::escape)) dialog.chosen = dialog.choices.size() - 1;
    if (pressed(key::enter) || pressed(key::pad_enter) || pressed(key::space)) dialog.chosen = dialog.focused;
}

// Right-aligned. The first choice is the outermost, away from the others. File names may be shortened; the text of the dialog has them.
void draw_choices(PanelContext& c, ModalDialog& dialog) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float em = ImGui::GetFontSize(), gap = style.ItemSpacing.x;
    std::vector<std::string> labels;
    std::vector<float> widths;
    for (const std::string& choice : dialog.choices) {
        labels.push_back(elided_middle(choice, 15 * em));
        widths.push_back(std::max(7 * em, ImGui::CalcTextSize(labels.back().c_str()).x + 2 * style.FramePadding.x));
    }
    const float all = std::accumulate(widths.begin(), widths.end(), gap * float(widths.size() - 1));
    ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), ImGui::GetWindowContentRegionMax().x - all));
    move_focus(dialog);
    for (size_t i = dialog.choices.size(); i-- > 0;) {
        if (ImGui::Button((labels[i] + "##" + dialog.choices[i]).c_str(), {widths[i], 0})) dialog.chosen = i;
        if (i == dialog.focused)
            ImGui::GetWindowDrawList()->AddRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), tone::text, style.FrameRounding);
        c.ui.probe.record_last_item("Dialog/" + dialog.choices[i]);
        if (i > 0) ImGui::SameLine();
    }
    choose_by_key(dialog);
}

} // namespace

void draw_modal_dialog(PanelContext& c) {
    if (!c.ui.dialog) return;
    constexpr const char* name = "Blush###dialog";
    if (!ImGui::IsPopupOpen(name)) ImGui::OpenPopup(name);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(name, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoTitleBar))
        return;
    draw_texts(*c.ui.dialog);
    draw_choices(c, *c.ui.dialog);
    if (c.ui.dialog->chosen) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

} // namespace blush
