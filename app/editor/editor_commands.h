// Implements the window's commands as edits of the document and of UiState.
#pragma once

#include "ui/panel_context.h"

namespace blush {

// Executes the command if it only needs document and UI state: history, selection, lights, view, open panels. Returns false for
// the others (files, quit), which the editor executes.
bool run_command(Command command, PanelContext& c);

} // namespace blush
