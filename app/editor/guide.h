// Opens pages of the guide in the desktop's browser.
#pragma once

#include "core/result.h"
#include "ui/window/ui_state.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace blush {

// file:// address of a page of the guide, "guide/lighting.html#kinds-of-lights": bytes that addresses do not allow are percent-encoded (RFC
// 3986).
std::string guide_address(const std::filesystem::path& folder, std::string_view page);

// Opens the page with xdg-open, which runs on by itself. Errors: the guide is not installed, there is no xdg-open.
Result<void> open_guide(const std::filesystem::path& folder, std::string_view page);

// Opens the page that a panel or the menu requested (UiState::guide_page); if that fails, a toast shows the reason.
void open_requested_page(UiState& ui, const std::filesystem::path& folder);

} // namespace blush
