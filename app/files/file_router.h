// Dispatches files that were chosen in a file dialog or dropped on the window.
#pragma once

#include "app/editor/editor_convergence.h"
#include "app/editor/editor_snapshots.h"
#include "app/files/editor_files.h"
#include "app/files/editor_saving.h"
#include "ui/window/ui_state.h"

#include <filesystem>

namespace blush {

// Holds references: created where it is needed.
struct FileRouter {
    EditorFiles& files;
    EditorSaving& saving;
    EditorSnapshots& snapshots;
    EditorConvergence& convergence;
    Document& document;
    UiState& ui;

    // Opens the file browser in the last folder of this file type.
    void browse(FileRequest::Use use);
    // Opens it for a command that needs a file; false for other commands.
    bool browse_for(Command command);
    void take(const FileRequest& request);
    // By its extension; an unknown one gives an error toast.
    void dispatch_dropped(const std::filesystem::path& file);
};

} // namespace blush
