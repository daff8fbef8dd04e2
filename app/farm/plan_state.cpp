#include "app/farm/plan_state.h"

#include "app/commands/plan/status.h"
#include "app/commands/plan/task_log.h"
#include "app/farm/plan_activity.h"

#include <algorithm>
#include <fmt/format.h>

namespace blush {
namespace {

// The line of a task that Stop ended: no failure.
bool was_stopped(const std::string& line) { return line.find(stopped_by_signal) != std::string::npos; }

void add_costs(const RenderPlan& plan, FarmPlan& state) {
    const Workload work{int64_t(plan.looks.size()), plan.spp, plan.chunk};
    const std::vector<Scaling> table = scaling_table(plan.costs, work);
    state.seconds_here = table.front().seconds;
    state.knee = knee_of(table);
    state.seconds_knee = simulate(plan.costs, work, state.knee).seconds;
    const int64_t parts_of_look = (plan.spp + plan.chunk - 1) / plan.chunk;
    state.disk_mib = plan.costs.part_mib * double(plan.looks.size()) * double(parts_of_look + 1);
}

} // namespace

FarmPlan read_farm_plan(const std::filesystem::path& folder) {
    FarmPlan state;
    state.folder = folder;
    const Result<RenderPlan> plan = read_plan(folder);
    if (!plan) {
        state.state = FarmPlan::State::unreadable;
        state.problem = plan.error().text();
        return state;
    }
    const PlanStatus status = status_of(folder, *plan);
    state.tasks = status.tasks;
    state.done = status.tasks - int64_t(status.missing.size());
    state.running = status.running;
    state.fraction = status.fraction();
    state.seconds_left = status.seconds_left;
    for (size_t i = 0; i < status.looks.size(); ++i) {
        const LookProgress& look = status.looks[i];
        // With an error to reach, the number of samples is that of the tasks so far.
        const int64_t planned = plan->error > 0 ? look.planned : plan->spp;
        state.looks.push_back({plan->looks[i].name, look.last, planned, look.merged_samples, look.error});
    }
    for (const FailedTask& task : status.failed)
        if (!was_stopped(task.last_line))
            state.failures.push_back(fmt::format("Task {} of {} failed: {}", task.number, task.look, task.last_line));
    add_costs(*plan, state);
    const bool merged = std::ranges::all_of(status.looks, [](const LookProgress& look) { return look.merged; });
    state.state = runs_here(folder) || runs_in_slurm(folder) ? FarmPlan::State::running
                  : status.complete() && merged              ? FarmPlan::State::finished
                                                             : FarmPlan::State::stopped;
    if (state.state == FarmPlan::State::stopped) {
        // A stopped task and the shell that reports its end write to one log, in any order.
        const std::string words = last_words(folder / local_log);
        if (!was_stopped(words)) state.problem = words;
    }
    return state;
}

std::filesystem::path merged_image(const FarmPlan& plan, const FarmLook& look) { return plan.folder / "merged" / (look.name + ".exr"); }

} // namespace blush
