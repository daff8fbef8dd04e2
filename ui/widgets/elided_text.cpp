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

// Bytes at the beginning of the text that are at most this wide, without half a character.
size_t fitting_bytes(const char* text, size_t length, float width) {
    size_t fits = 0, too_long = length;
    while (fits + 1 < too_long) {
        const size_t middle = (fits + too_long) / 2;
        (width_of(text, text + middle) <= width ? fits : too_long) = middle;
    }
    while (fits > 0 && continues_character(text[fits])) --fits;
    return fits;
}

// Draws `shown` over a field that is not being edited and whose text is longer.
template <class Input> bool input_under(UiState& ui, const std::string& text, const std::string& shown, const Input& input) {
    const ImU32 color = ImGui::GetColorU32(ImGuiCol_Text);
    const ImVec2 at = ImGui::GetCursorScreenPos(), padding = ImGui::GetStyle().FramePadding;
    ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(0, 0, 0, 0));
    const bool changed = input();
    ImGui::PopStyleColor();
    ImGui::GetWindowDrawList()->AddText({at.x + padding.x, at.y + padding.y}, color, shown.c_str());
    tip_for_last_item(ui, text.c_str());
    return changed;
}

float room_for_input() { return ImGui::CalcItemWidth() - 2 * ImGui::GetStyle().FramePadding.x; }
bool is_edited(const char* id) { return ImGui::GetActiveID() == ImGui::GetID(id); }

} // namespace

std::string elided(const std::string& text, float width) {
    const size_t hidden = text.find("##");
    const size_t length = std::min(hidden, text.size());
    const char* const begin = text.c_str();
    if (width_of(begin, begin + length) <= width) return text;
    const size_t fits = fitting_bytes(begin, length, width - width_of(ellipsis, ellipsis + 3));
    return text.substr(0, fits) + ellipsis + text.substr(length);
}

std::string elided_middle(const std::string& text, float width) {
    const char* const begin = text.c_str();
    if (width_of(begin, begin + text.size()) <= width) return text;
    const float room = width - width_of(ellipsis, ellipsis + 3);
    const size_t head = fitting_bytes(begin, text.size(), room / 2);
    const float left = room - width_of(begin, begin + head);
    size_t tail = head, end = text.size();
    while (tail < end) {
        const size_t middle = (tail + end) / 2;
        if (width_of(begin + middle, begin + text.size()) <= left)
            end = middle;
        else
            tail = middle + 1;
    }
    while (tail < text.size() && continues_character(text[tail])) ++tail;
    return text.substr(0, head) + ellipsis + text.substr(tail);
}

void elided_text(UiState& ui, const std::string& text, ImU32 color, float width) {
    const std::string shown = elided(text, width > 0 ? width : ImGui::GetContentRegionAvail().x);
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(shown.c_str());
    ImGui::PopStyleColor();
    if (shown != text) tip_for_last_item(ui, text.c_str());
}

bool elided_input(UiState& ui, const char* id, std::string& text, ImGuiInputTextFlags flags) {
    const auto input = [&] { return ImGui::InputText(id, &text, flags); };
    const std::string shown = is_edited(id) ? text : elided(text, room_for_input());
    return shown == text ? input() : input_under(ui, text, shown, input);
}

bool elided_path_input(UiState& ui, const char* id, std::string& path, ImGuiInputTextFlags flags, ImGuiInputTextCallback complete,
                       void* data) {
    const auto input = [&] { return ImGui::InputText(id, &path, flags, complete, data); };
    const std::string shown = is_edited(id) ? path : elided_middle(path, room_for_input());
    return shown == path ? input() : input_under(ui, path, shown, input);
}

void same_line_if_fits(float width, float gap) {
    const float space = gap < 0 ? ImGui::GetStyle().ItemSpacing.x : gap;
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (ImGui::GetItemRectMax().x + space + width <= right) ImGui::SameLine(0, space);
}

} // namespace blush
