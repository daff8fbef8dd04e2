// Where files go that were chosen in the browser or dropped on the window.
#pragma once

#include "app/editor_convergence.h"
#include "app/editor_files.h"
#include "app/editor_saving.h"
#include "app/editor_snapshots.h"
#include "ui/ui_state.h"

#include <filesystem>

namespace blush {

// By reference: made where it is needed.
struct FileTakers {
    EditorFiles& files;
    EditorSaving& saving;
    EditorSnapshots& snapshots;
    EditorConvergence& convergence;
    Document& document;
    UiState& ui;

    // Opens the browser in the folder where such files were last.
    void browse(FileRequest::Use use);
    // The same for a command that asks for a file; false for any other.
    bool browse_for(Command command);
    void take(const FileRequest& request);
    // By its extension; one that nobody takes is said.
    void take_dropped(const std::filesystem::path& file);
};

} // namespace blush
