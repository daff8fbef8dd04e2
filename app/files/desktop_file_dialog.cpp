#include "app/files/desktop_file_dialog.h"

namespace blush {
namespace {

void request(UiState& ui, FileRequest::Use use, std::filesystem::path path) {
    if (use == FileRequest::Use::save_scene && !matches(scene_files, path)) {
        path += ".gltf";
        // The desktop has asked about replacing the name without the extension.
        std::error_code unreadable;
        if (std::filesystem::exists(path, unreadable))
            return ui.toasts.fail("The scene was not saved: the file " + path.filename().string() + " exists",
                                  "Choose that file in the dialog to replace it.");
    }
    ui.settings.browser_folder = (use == FileRequest::Use::snapshot_folder ? path : path.parent_path()).string();
    ui.files.push_back({use, std::move(path)});
}

} // namespace

void DesktopFileDialog::poll(UiState& ui) {
    if (ui.browser && ui.browser->just_opened && !ui.browser->on_desktop && usable_ && ui.settings.desktop_file_dialog &&
        may_have_session_bus()) {
        const FileBrowser& b = *ui.browser;
        const bool saves = b.use == FileRequest::Use::save_scene;
        const PortalRequest request{b.use, b.folder, saves ? std::filesystem::path(b.typed).filename().string() : ""};
        job_ = std::make_unique<BackgroundJob<PortalAnswer>>(
            title_of(b.use), [request](JobProgress& progress) { return ask_portal(request, progress.cancel); }, wake_);
        ui.browser->on_desktop = true;
    }
    if (!job_) return;
    if (!ui.browser || !ui.browser->on_desktop) return job_.reset(); // replaced by a modal dialog
    const std::optional<PortalAnswer> answer = job_->take();
    if (!answer) return;
    job_.reset();
    if (answer->outcome == PortalAnswer::Outcome::no_portal) {
        usable_ = false;
        ui.browser->on_desktop = false; // show the window's file browser
        return;
    }
    if (answer->outcome == PortalAnswer::Outcome::chosen) request(ui, ui.browser->use, answer->path);
    ui.browser.reset();
}

} // namespace blush
