// What the window's commands do to the document and to the window's state.
#pragma once

#include "ui/panels/context.h"

namespace blush {

// True if the command is one of those that need nothing but document and state: history, selection, lights, view, open panels.
// The others (files, quitting) are the editor's own.
bool run_command(Command command, PanelContext& c);

} // namespace blush
