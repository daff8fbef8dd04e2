// Uses the desktop's file dialog, if available, instead of the window's file browser.
#pragma once

#include "app/files/portal_dialog.h"
#include "ui/jobs/background_job.h"
#include "ui/window/ui_state.h"

#include <functional>
#include <memory>

namespace blush {

class DesktopFileDialog {
public:
    explicit DesktopFileDialog(std::function<void()> wake) : wake_(std::move(wake)) {}

    // Call once per frame, before the file browser is drawn. Takes over a new request, unless the settings disable it or the
    // desktop has no dialog. The answer is in ui.files, as with the file browser.
    void poll(UiState& ui);

private:
    std::function<void()> wake_;
    bool usable_ = true;
    std::unique_ptr<BackgroundJob<PortalAnswer>> job_;
};

} // namespace blush
