#include "ui/window/imgui_state.h"

#include "ui/window/shortcuts.h"

#include <algorithm>
#include <imgui.h>
#include <imgui_internal.h> // the stack of popups, and what a frame leaves to the next one
#include <string_view>

namespace blush {

bool any_popup_open() { return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel); }

void navigate_popups_by_keys() {
    ImGuiContext& g = *ImGui::GetCurrentContext();
    ImGuiIO& io = g.IO;
    const ImGuiWindow* const top = g.OpenPopupStack.empty() ? nullptr : g.OpenPopupStack.back().Window;
    // While an arrow key goes from one menu to the next, none is open for a frame.
    const bool navigates = top ? !(top->Flags & ImGuiWindowFlags_Modal) : g.NavMoveForwardToNextFrame;
    const bool ends = !navigates && (io.ConfigFlags & ImGuiConfigFlags_NavEnableKeyboard);
    io.ConfigFlags = navigates ? io.ConfigFlags | ImGuiConfigFlags_NavEnableKeyboard : io.ConfigFlags & ~ImGuiConfigFlags_NavEnableKeyboard;
    if (ends) g.NavDisableHighlight = true; // no frame stays round the widget that opened the popup
    // Esc remains the editor's: ImGui would close a popup, and the editor the next thing.
    io.KeyMap[ImGuiKey_Escape] = navigates && !io.WantTextInput ? -1 : key::escape;
    const auto is_pressed = [&](int key) { return io.KeysDown[key] && io.KeysDownDuration[key] < 0; };
    // In a menu the first press of Down only shows the focus, which is on the first entry; a combo box begins at its current entry.
    const bool is_menu = top && navigates && std::string_view(top->Name).substr(0, 7) != "##Combo",
               shows_focus = is_menu && !io.WantTextInput && g.NavDisableHighlight && is_pressed(key::down);
    if (shows_focus) {
        g.NavDisableHighlight = false;
        g.NavDisableMouseHover = true;
    }
    const bool until_released = io.KeyMap[ImGuiKey_DownArrow] == -1 && io.KeysDown[key::down];
    io.KeyMap[ImGuiKey_DownArrow] = shows_focus || until_released ? -1 : key::down;
    // ImGui chooses by Space alone.
    if (navigates && !io.WantTextInput && (is_pressed(key::enter) || is_pressed(key::pad_enter))) io.NavInputs[ImGuiNavInput_Activate] = 1;
}

bool close_top_popup() {
    if (!any_popup_open()) return false;
    ImGui::ClosePopupToLevel(ImGui::GetCurrentContext()->OpenPopupStack.Size - 1, true);
    return true;
}

bool needs_another_frame() {
    ImGuiContext& g = *ImGui::GetCurrentContext();
    // The draw data does not show a pending request for the keyboard, or a field that has just got it.
    if (g.NavMoveSubmitted || (g.WantTextInputNextFrame == 1) != g.IO.WantTextInput) return true;
    for (int i = 0; i < g.TabBars.GetMapSize(); ++i) {
        const ImGuiTabBar* const tabs = g.TabBars.TryGetMapData(i);
        if (tabs && tabs->CurrFrameVisible == g.FrameCount && tabs->ScrollingAnim != tabs->ScrollingTarget) return true;
    }
    return std::any_of(g.Windows.begin(), g.Windows.end(),
                       [](const ImGuiWindow* w) { return w->Active && w->HiddenFramesCannotSkipItems > 0; });
}

} // namespace blush
