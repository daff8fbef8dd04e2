// The desktop's file dialog through xdg-desktop-portal: org.freedesktop.portal.FileChooser on the session's D-Bus.
// https://flatpak.github.io/xdg-desktop-portal/docs/doc-org.freedesktop.portal.FileChooser.html
#pragma once

#include "ui/window/file_request.h"

#include <atomic>
#include <filesystem>
#include <string>

namespace blush {

struct PortalRequest {
    FileRequest::Use use = FileRequest::Use::open;
    std::filesystem::path folder; // initial folder
    std::string name;             // default name for saving
};

struct PortalAnswer {
    enum class Outcome { chosen, cancelled, no_portal };
    Outcome outcome = Outcome::no_portal;
    std::filesystem::path path; // if `chosen`: absolute
};

// False if there is certainly no session bus: only checks the environment, without a request.
bool may_have_session_bus();

// Shows the dialog and blocks until its answer; for a background thread. Returns `cancelled` soon after `cancel` is set.
// no_portal: no bus, no portal, the portal refuses or disappears, or it does not confirm within 3 seconds that it shows a dialog.
PortalAnswer ask_portal(const PortalRequest& request, const std::atomic<bool>& cancel);

// The path of a local file:// URI; empty for other URIs and for invalid encodings.
std::filesystem::path path_of_uri(std::string_view uri);

} // namespace blush
