// `blush plan run DIR TASK`: what a worker does.
#pragma once

#include "app/commands/plan/render_part.h"

namespace blush {

struct TaskResult {
    SampleSpan rendered; // empty (first == last): all samples were there already
    double seconds = 0;
};

// Renders the samples of the task (1 .. number of tasks) that no valid part holds. Any number of workers may do so at once: the parts
// are the same to the bit, and each is renamed into place as a whole. Errors: no such task, another scene or version than planned,
// interrupted (the samples so far are in a part), cannot write.
Result<TaskResult> run_task(const std::filesystem::path& folder, size_t number, const RenderRun& run);

} // namespace blush
