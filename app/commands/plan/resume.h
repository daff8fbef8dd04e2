// `blush plan resume DIR`: what is still to do, and the next round of a plan in rounds: with adaptive sampling, or to reach an error.
#pragma once

#include "app/commands/plan/status.h"

namespace blush {

struct Resumed {
    size_t added = 0; // tasks of a new round
    PlanStatus status;
};

// Samples that a look needs in all to get from this upper end of its error's interval, after `samples`, to `wanted`: the error falls
// with their number. At most four times as many, as the estimate is itself uncertain; a multiple of `chunk`, at most `limit`.
// `high` 0: not known.
int64_t samples_to_reach(double wanted, double high, int64_t samples, int64_t chunk, int64_t limit);

// The upper end of an error's text, "0.0012 (0.0010 to 0.0014)"; 0 if it is not known.
double upper_end(const std::string& error);

// Writes missing.txt. In a plan in rounds: merges the looks whose tasks are done, decides the allocations of those whose pilot is
// merged, and adds tasks for those that lack samples or whose interval does not say yet that they have reached the error. The
// plan's files are written again then. Errors: a merge fails, cannot write.
Result<Resumed> resume_plan(const std::filesystem::path& folder, RenderPlan& plan, unsigned threads);

} // namespace blush
