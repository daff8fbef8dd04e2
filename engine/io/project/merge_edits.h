// Three-way merge of scenes: applies local edits to a file that changed on disk.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace blush {

struct MergedEdits {
    Scene scene;                        // valid (scene/validate.h)
    std::vector<std::string> conflicts; // a message for each value that both sides changed and for each edited record that is gone
};

// Applies the edits from `base` (the file as opened) to `mine` onto `theirs` (the file now). Records are matched by name: nodes
// by their path, others by name or by the path of the first node that uses them; records of equal name in order. A field that
// only one side changed is taken from that side; if both changed it, mine is kept and reported as a conflict. Added records are
// added, removed records removed. The view and the chosen clip, scene and variant stay mine.
MergedEdits merge_edits(const Scene& base, const Scene& mine, const Scene& theirs);

// A base for merge_edits() if another program wrote `theirs` over `saved` and the scene before is not known: `saved` without the
// lights that theirs lacks, and with the environment and light mix of theirs, which other programs do not write. These count as
// edits then.
Scene without_lighting_missing_in(const Scene& theirs, const Scene& saved);

} // namespace blush
