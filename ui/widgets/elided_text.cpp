#include "ui/widgets/elided_text.h"

#include "ui/widgets/tooltip.h"

#include <algorithm>
#include <imgui_internal.h> // which field is being edited
#include <imgui_stdlib.h>

namespace blush {
namespace {

constexpr const char* ellipsis = "…";

float width_of(const char* begin, const char* end) { return ImGui::CalcTextSize(begin, end).x; }

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

} // namespace

std::string elided(const std::string& text, float width) {
    const size_t hidden = text.find("##");
    const size_t length = std::min(hidden, text.size());
    const char* const begin = text.c_str();
    if (width_of(begin, begin + length) <= width) return text;
    const float room = width - width_of(ellipsis, ellipsis + 3);
    size_t fits = 0, too_long = length; // bytes
    while (fits + 1 < too_long) {
        const size_t middle = (fits + too_long) / 2;
        (width_of(begin, begin + middle) <= room ? fits : too_long) = middle;
    }
    while (fits > 0 && continues_character(text[fits])) --fits;
    return text.substr(0, fits) + ellipsis + text.substr(length);
}

void elided_text(UiState& ui, const std::string& text, ImU32 color, float width) {
    const std::string shown = elided(text, width > 0 ? width : ImGui::GetContentRegionAvail().x);
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(shown.c_str());
    ImGui::PopStyleColor();
    if (shown != text) tip_for_last_item(ui, text.c_str());
}

bool elided_input(UiState& ui, const char* id, std::string& text, ImGuiInputTextFlags flags) {
    const float room = ImGui::CalcItemWidth() - 2 * ImGui::GetStyle().FramePadding.x;
    const bool edited = ImGui::GetActiveID() == ImGui::GetID(id);
    const std::string shown = edited ? text : elided(text, room);
    if (edited || shown == text) return ImGui::InputText(id, &text, flags);
    const ImU32 color = ImGui::GetColorU32(ImGuiCol_Text);
    const ImVec2 at = ImGui::GetCursorScreenPos(), padding = ImGui::GetStyle().FramePadding;
    ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(0, 0, 0, 0));
    const bool changed = ImGui::InputText(id, &text, flags);
    ImGui::PopStyleColor();
    ImGui::GetWindowDrawList()->AddText({at.x + padding.x, at.y + padding.y}, color, shown.c_str());
    tip_for_last_item(ui, text.c_str());
    return changed;
}

void same_line_if_fits(float width, float gap) {
    const float space = gap < 0 ? ImGui::GetStyle().ItemSpacing.x : gap;
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (ImGui::GetItemRectMax().x + space + width <= right) ImGui::SameLine(0, space);
}

} // namespace blush
