#include "ui/value_menu.h"

#include "ui/value_text.h"

#include <imgui.h>

namespace blush {
namespace {

// Longest clipboard text that is read: more than any value needs.
constexpr size_t longest_pasted = 4096;

ValueWish menu(UiState& ui, const std::string& name, bool is_color, bool has_siblings) {
    ValueWish wish = ValueWish::none;
    const auto item = [&](const char* text, ValueWish meant, const char* key = nullptr) {
        if (ImGui::MenuItem(text, key)) wish = meant;
        ui.probe.record_last_item(name + "/" + text);
    };
    const std::string copy = keys_of(shortcut(Command::copy_value)), paste = keys_of(shortcut(Command::paste_value)),
                      reset = keys_of(shortcut(Command::reset_value));
    item(is_color ? "Copy as linear RGB" : "Copy", ValueWish::copy, copy.c_str());
    if (is_color) {
        item("Copy as hex", ValueWish::copy_hex);
        item("Copy as sRGB", ValueWish::copy_srgb);
    }
    if (has_siblings) item("Copy all three", ValueWish::copy_all);
    item("Paste", ValueWish::paste, paste.c_str());
    ImGui::Separator();
    if (is_color) item("Pick from the picture", ValueWish::pick);
    item("Reset to default", ValueWish::reset, reset.c_str());
    return wish;
}

} // namespace

void wish_of_value(UiState& ui, ValueWish wish) {
    ui.values.wish = wish;
    ui.values.wish_frame = ImGui::GetFrameCount() + 1;
    ui.next_frame_in = 0;
}

ValueWish value_wish(UiState& ui, const std::string& name, bool is_color, bool has_siblings) {
    const bool hovered = ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) && !ImGui::IsItemActive();
    ValueWish wish = ValueWish::none;
    if (hovered && ui.values.wish_frame == ImGui::GetFrameCount()) {
        wish = ui.values.wish;
        ui.values.wish_frame = -1;
    }
    ImGui::PushID(name.c_str());
    if (hovered && ImGui::IsMouseReleased(ImGuiMouseButton_Right)) ImGui::OpenPopup("value");
    if (ImGui::BeginPopup("value")) {
        if (const ValueWish chosen = menu(ui, name, is_color, has_siblings); chosen != ValueWish::none) wish = chosen;
        ImGui::EndPopup();
    }
    ImGui::PopID();
    return wish;
}

std::string pasted_text() {
    const char* text = ImGui::GetClipboardText();
    if (!text) return {};
    const std::string_view all(text);
    return all.size() > longest_pasted ? std::string() : std::string(all);
}

void copy_text(UiState& ui, const std::string& text) {
    ImGui::SetClipboardText(text.c_str());
    ui.toasts.note("Copied " + text);
}

void refuse_pasted(UiState& ui, const std::string& field, const char* wanted) {
    const std::string text = shown_of(pasted_text());
    ui.toasts.warn(text.empty() ? "The clipboard has no text that " + field + " accepts" : "\"" + text + "\" is not a value for " + field,
                   wanted);
}

} // namespace blush
