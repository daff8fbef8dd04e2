#include "ui/window/imgui_state.h"

#include <algorithm>
#include <imgui.h>
#include <imgui_internal.h> // the stack of popups, and what a frame leaves to the next one

namespace blush {

bool any_popup_open() { return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel); }

bool close_top_popup() {
    if (!any_popup_open()) return false;
    ImGui::ClosePopupToLevel(ImGui::GetCurrentContext()->OpenPopupStack.Size - 1, true);
    return true;
}

bool needs_another_frame() {
    const ImGuiContext& g = *ImGui::GetCurrentContext();
    // Neither a pending request for the keyboard nor a field that has just got it is seen in the draw data.
    if (g.NavMoveSubmitted || (g.WantTextInputNextFrame == 1) != g.IO.WantTextInput) return true;
    return std::any_of(g.Windows.begin(), g.Windows.end(),
                       [](const ImGuiWindow* w) { return w->Active && w->HiddenFramesCannotSkipItems > 0; });
}

} // namespace blush
