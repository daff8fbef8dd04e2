// Three-way merge of a scene: what was edited here, on top of a file that changed on disk.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace blush {

struct MergedEdits {
    Scene scene;                        // valid (scene/validate.h)
    std::vector<std::string> conflicts; // a sentence for each thing that both sides changed, or that an edit no longer finds
};

// `theirs`, the file as it is now, with the edits that led from `base`, the file as it was opened, to `mine`. Records are matched by what they are called:
// nodes by their path, all else by name, or the path of the first node that uses it, and those of one name in order. Fields that only one side changed
// are taken from that side; where both changed one, mine is kept and named among the conflicts. Added records are added, removed ones removed. The
// view and the chosen clip, scene and variant stay mine.
MergedEdits merge_edits(const Scene& base, const Scene& mine, const Scene& theirs);

} // namespace blush
