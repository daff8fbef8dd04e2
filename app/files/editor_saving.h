// Saving, unsaved edits and crash recovery; asks before edits are lost.
#pragma once

#include "app/files/autosave.h"
#include "app/files/editor_files.h"

#include <functional>
#include <optional>

namespace blush {

class EditorSaving {
public:
    // `assets`: its scenes are shipped; saving one asks for another location. `interval`: of autosaves, in seconds; 0: default.
    EditorSaving(EditorFiles& files, Document& document, UiState& ui, std::filesystem::path assets, double interval);

    // Saves to the scene's file. Before the first save over a file that Blush did not write, asks for a file.
    void save();
    // Opens the file browser with the file name `proposed`; empty: the scene's name.
    void ask_for_file(const std::filesystem::path& proposed = {});
    // Handles the answer of the file browser.
    void save_as(const std::filesystem::path& file);
    // Runs `then` at once if there are no unsaved edits, else after the user has saved or discarded them; never if the user
    // cancels. `doing`: for the message, for example "closing the window".
    void before_losing_edits(const std::string& doing, std::function<void()> then);
    // Asks whether to keep the edits, if there are any, and continues unless the user cancels.
    void before_reloading(std::function<void(bool keep_edits)> then);
    // Offers the sidecar of a crash for this scene or, with an empty path, for any scene.
    void offer_recovery(const std::filesystem::path& scene);

    // Call both once per frame: with the result of files.poll(), and after the panels were drawn.
    void poll(const EditorFiles::Finished& finished);
    void poll_dialog();
    // The window is closing: removes the sidecar.
    void end() { autosave_.forget(); }

private:
    void ask(ModalDialog dialog, std::function<void(size_t)> answer);
    void ask_about_foreign_file();
    std::filesystem::path name_beside_original() const;

    EditorFiles& files_;
    Document& document_;
    UiState& ui_;
    std::filesystem::path assets_;
    Autosave autosave_;
    std::function<void(size_t)> answer_;
    std::function<void()> after_save_; // called after a successful save
    std::optional<RecoveryFile> recovering_;
};

} // namespace blush
