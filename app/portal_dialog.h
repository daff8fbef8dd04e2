// The desktop's file dialog through xdg-desktop-portal: org.freedesktop.portal.FileChooser on the session's D-Bus.
// https://flatpak.github.io/xdg-desktop-portal/docs/doc-org.freedesktop.portal.FileChooser.html
#pragma once

#include "ui/file_request.h"

#include <atomic>
#include <filesystem>
#include <string>

namespace blush {

struct PortalRequest {
    FileRequest::Use use = FileRequest::Use::open;
    std::filesystem::path folder; // where the dialog begins
    std::string name;             // proposed, for saving
};

struct PortalAnswer {
    enum class Outcome { chosen, cancelled, no_portal };
    Outcome outcome = Outcome::no_portal;
    std::filesystem::path path; // of `chosen`: absolute
};

// False if there is no session bus for certain: asks nothing, looks at the environment alone.
bool may_have_session_bus();

// Shows the dialog and waits for its answer; for a thread of its own. Ends with `cancelled` soon after `cancel` is set. no_portal: no bus, no portal,
// a portal that refuses or vanishes, or one that does not confirm within 3 seconds that it shows a dialog.
PortalAnswer ask_portal(const PortalRequest& request, const std::atomic<bool>& cancel);

// The path of a file:// URI of this machine; empty for any other and for bytes that are not encoded well.
std::filesystem::path path_of_uri(std::string_view uri);

} // namespace blush
