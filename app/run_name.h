// What a run of the Convergence panel is called: by what was changed before it began.
#pragma once

#include "scene/changes.h"
#include "scene/document.h"

#include <string>

namespace blush {

// The settings in which the second differs from the first: "Path reuse 8, Adaptive sampling on". Empty if it is
// only stop rules and sizes.
std::string settings_difference(const RenderSettings& before, const RenderSettings& after);

// What was handed to the session.
struct Submitted {
    const Scene& scene;
    const RenderSettings& settings;
};
// Of the run that begins when what is rendered differs. The document's last step names an edit of the scene, or the step that was undone;
// navigation leaves no step.
std::string run_name(const Submitted& before, const Submitted& after, const Document& document, bool undone);

} // namespace blush
