// `blush plan merge DIR`: from parts to images.
#pragma once

#include "app/commands/plan/parts.h"

#include <atomic>

namespace blush {

// How a look stands.
struct LookProgress {
    std::vector<Part> parts; // all that are valid
    std::vector<Part> chain; // of these, from sample 0 on, without gap
    int64_t last = 0;        // samples of the chain
    int64_t planned = 0;     // end of the last task
    bool merged = false;     // the merged image has the samples of the chain
    std::string error = {};  // of the merged image, as text; empty if not known
    int64_t merged_samples = 0;
    bool complete() const { return last >= planned; }
};
// The ends of the samples that tasks of the plan cover, of each look.
std::vector<int64_t> planned_samples(const RenderPlan& plan);
// `planned`: the entry of this look in planned_samples().
LookProgress look_progress(const std::filesystem::path& folder, const RenderPlan& plan, size_t look, int64_t planned);

// MERGED/LOOK.png, if it is of the merged image as it is now.
std::filesystem::path display_file(const std::filesystem::path& folder, const PlanLook& look);

// Merges the chain of the look's parts into MERGED/LOOK.exr, and removes the display image of the one before, unless that is there already.
// A part that turns out to be damaged is removed, so that its samples are missing again. Errors: no parts, a damaged part, cannot write.
Result<LookProgress> merge_look(const std::filesystem::path& folder, const RenderPlan& plan, size_t look, int64_t planned,
                                unsigned threads);

} // namespace blush
