// Lets the desktop's own file dialog ask for a file where there is one, in place of the window's.
#pragma once

#include "app/portal_dialog.h"
#include "ui/background_job.h"
#include "ui/ui_state.h"

#include <functional>
#include <memory>

namespace blush {

class DesktopFileDialog {
public:
    explicit DesktopFileDialog(std::function<void()> wake) : wake_(std::move(wake)) {}

    // Once per frame, before the window's own dialog is drawn. Takes over one that has just been asked for, unless the settings say otherwise or the
    // desktop has shown that it has none. Its answer comes as the own dialog's does: in ui.files.
    void poll(UiState& ui);

private:
    std::function<void()> wake_;
    bool usable_ = true;
    std::unique_ptr<BackgroundJob<PortalAnswer>> job_;
};

} // namespace blush
