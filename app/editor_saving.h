// Nothing is lost without being asked: saving, unsaved edits, and what a crash has left.
#pragma once

#include "app/autosave.h"
#include "app/editor_files.h"

#include <functional>
#include <optional>

namespace blush {

class EditorSaving {
public:
    // `assets`: scenes in there are shipped; saving them asks for another place. `interval`: of autosaves, in seconds; 0: the usual one.
    EditorSaving(EditorFiles& files, Document& document, UiState& ui, std::filesystem::path assets, double interval);

    // To the scene's own file, or to one that the user is asked for: before the first save over a file that Blush did not write.
    void save();
    // Opens the browser, with `proposed` as the name; empty: the scene's own.
    void ask_for_file(const std::filesystem::path& proposed = {});
    // The browser's answer.
    void save_as(const std::filesystem::path& file);
    // `go_on` runs at once if everything is saved, else when the user has saved or discarded; not at all if they cancel.
    // `doing`: "closing the window".
    void before_losing_edits(const std::string& doing, std::function<void()> go_on);
    // Asks whether edits are kept, if there are any, and goes on unless the user cancels.
    void before_reloading(std::function<void(bool keep_edits)> go_on);
    // Offers the edits that a crash has left of this scene, or, with an empty path, of any.
    void offer_recovery(const std::filesystem::path& scene);

    // Once per frame, with what files.poll() has said; and after the panels were drawn.
    void poll(const EditorFiles::Finished& finished);
    void hear_answer();
    // The window closes by itself: no edits are left to recover.
    void end() { autosave_.forget(); }

private:
    void ask(Question question, std::function<void(size_t)> answer);
    void ask_about_foreign_file();
    std::filesystem::path name_beside_original() const;

    EditorFiles& files_;
    Document& document_;
    UiState& ui_;
    std::filesystem::path assets_;
    Autosave autosave_;
    std::function<void(size_t)> answer_;
    std::function<void()> go_on_; // when the save has succeeded
    std::optional<Leftover> recovering_;
};

} // namespace blush
