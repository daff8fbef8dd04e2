#include "ui/widgets/value_menu.h"

#include "ui/widgets/value_text.h"

#include <imgui.h>

namespace blush {
namespace {

// Longest clipboard text that is read: more than any value needs.
constexpr size_t max_pasted = 4096;

ValueAction menu(UiState& ui, const std::string& name, bool is_color, bool has_siblings) {
    ValueAction requested = ValueAction::none;
    const auto item = [&](const char* text, ValueAction meant, const char* key = nullptr) {
        if (ImGui::MenuItem(text, key)) requested = meant;
        ui.probe.record_last_item(name + "/" + text);
    };
    const std::string copy = keys_of(shortcut(Command::copy_value)), paste = keys_of(shortcut(Command::paste_value)),
                      reset = keys_of(shortcut(Command::reset_value));
    item(is_color ? "Copy as linear RGB" : "Copy", ValueAction::copy, copy.c_str());
    if (is_color) {
        item("Copy as hex", ValueAction::copy_hex);
        item("Copy as sRGB", ValueAction::copy_srgb);
    }
    if (has_siblings) item("Copy all three", ValueAction::copy_all);
    item("Paste", ValueAction::paste, paste.c_str());
    ImGui::Separator();
    if (is_color) item("Pick from the image", ValueAction::pick);
    item("Reset to default", ValueAction::reset, reset.c_str());
    return requested;
}

} // namespace

void request_value_action(UiState& ui, ValueAction requested) {
    ui.values.requested = requested;
    ui.values.action_frame = ImGui::GetFrameCount() + 1;
    ui.seconds_to_next_frame = 0;
}

ValueAction value_action(UiState& ui, const std::string& name, bool is_color, bool has_siblings) {
    const bool hovered = ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) && !ImGui::IsItemActive();
    ValueAction requested = ValueAction::none;
    if (hovered && ui.values.action_frame == ImGui::GetFrameCount()) {
        requested = ui.values.requested;
        ui.values.action_frame = -1;
    }
    ImGui::PushID(name.c_str());
    if (hovered && ImGui::IsMouseReleased(ImGuiMouseButton_Right)) ImGui::OpenPopup("value");
    if (ImGui::BeginPopup("value")) {
        if (const ValueAction chosen = menu(ui, name, is_color, has_siblings); chosen != ValueAction::none) requested = chosen;
        ImGui::EndPopup();
    }
    ImGui::PopID();
    return requested;
}

std::string pasted_text() {
    const char* text = ImGui::GetClipboardText();
    if (!text) return {};
    const std::string_view all(text);
    return all.size() > max_pasted ? std::string() : std::string(all);
}

void copy_text(UiState& ui, const std::string& text) {
    ImGui::SetClipboardText(text.c_str());
    ui.toasts.note("Copied " + text);
}

void warn_invalid_paste(UiState& ui, const std::string& field, const char* wanted) {
    const std::string text = shown_of(pasted_text());
    ui.toasts.warn(text.empty() ? "The clipboard has no text that " + field + " accepts" : "\"" + text + "\" is not a value for " + field,
                   wanted);
}

} // namespace blush
