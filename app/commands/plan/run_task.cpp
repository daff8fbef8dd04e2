#include "app/commands/plan/run_task.h"

#include "app/commands/interrupt.h"
#include "app/commands/plan/task_log.h"

#include <fmt/format.h>

namespace blush {
namespace {

Result<TaskResult> render_missing(const std::filesystem::path& folder, const RenderPlan& plan, const PlanTask& task, const RenderRun& run,
                                  const InterruptGuard& guard) {
    const PlanLook& look = plan.looks[task.look];
    if (const Result<void> ready = provide_folder(folder, parts_folder(folder, look)); !ready) return ready.error();
    const SampleSpan missing = missing_in(valid_parts(folder, plan, look), task.samples);
    if (missing.first == missing.last) return TaskResult{missing, 0};
    const Result<LoadedScene> loaded = load_look(folder, plan, look, run, guard.interrupted());
    if (!loaded) return loaded.error();
    const Result<Part> part = render_part(folder, plan, look, *loaded, missing, run, guard.interrupted());
    if (!part) return part.error();
    if (part->samples != missing)
        return Error{.file = part->file.string(),
                     .what = fmt::format("{} with the samples {}:{} of {}:{}; run the task again for the rest", stopped_by_signal,
                                         missing.first, part->samples.last, missing.first, missing.last)};
    return TaskResult{missing, part->seconds};
}

} // namespace

Result<TaskResult> run_task(const std::filesystem::path& folder, size_t number, const RenderRun& run) {
    const InterruptGuard guard; // before there is a log, which must say how the task ended
    const Result<RenderPlan> plan = read_plan(folder);
    if (!plan) return plan.error();
    if (number < 1 || number > plan->tasks.size())
        return Error{.file = (folder / "plan.json").string(),
                     .what = fmt::format("has the tasks 1 to {}, not {}", plan->tasks.size(), number)};
    if (const Result<void> ready = provide_folder(folder, folder / "logs"); !ready) return ready.error();
    TaskLog log(folder, number);
    Result<TaskResult> result = render_missing(folder, *plan, plan->tasks[number - 1], run, guard);
    if (!result)
        log.line("error: " + result.error().text());
    else
        log.line(result->rendered.first == result->rendered.last
                     ? "done already"
                     : fmt::format("done: samples {}:{} in {:.2f} s", result->rendered.first, result->rendered.last, result->seconds));
    return result;
}

} // namespace blush
