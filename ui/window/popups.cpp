#include "ui/window/popups.h"

#include <imgui.h>
#include <imgui_internal.h> // the stack itself

namespace blush {

bool any_popup_open() { return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel); }

bool close_top_popup() {
    if (!any_popup_open()) return false;
    ImGui::ClosePopupToLevel(ImGui::GetCurrentContext()->OpenPopupStack.Size - 1, true);
    return true;
}

} // namespace blush
