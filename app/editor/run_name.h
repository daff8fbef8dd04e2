// Names of the runs in the Convergence panel: the edit that started them.
#pragma once

#include "scene/changes.h"
#include "scene/document/document.h"

#include <string>

namespace blush {

// The settings in which the second differs from the first: "Path reuse 8, Adaptive sampling on". Empty if only stop rules and
// sizes differ.
std::string settings_difference(const RenderSettings& before, const RenderSettings& after);

// The state given to the session.
struct RunState {
    const Scene& scene;
    const RenderSettings& settings;
};
// Name of the run after `changes` of the rendered image. An edit of the scene has the name of the document's last undo step, or of
// the step that was undone; navigation has no undo step.
std::string run_name(const RunState& before, const RunState& after, const Changes& changes, const Document& document, bool undone);

} // namespace blush
