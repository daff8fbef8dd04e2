#include "app/commands/plan/status.h"

#include "app/commands/plan/task_log.h"
#include "app/commands/progress.h"

#include <fmt/format.h>

#include <algorithm>

namespace blush {
namespace {

// Looks and failed tasks beyond these are only counted.
constexpr size_t shown_looks = 40, shown_failures = 10;

// As far as they are known: where an error is to be reached, those of its tasks.
int64_t wanted_samples(const RenderPlan& plan, const LookProgress& look) { return plan.error > 0 ? look.planned : plan.spp; }

// Samples of a task that parts hold.
int64_t held(const std::vector<Part>& parts, SampleSpan samples) {
    const SampleSpan missing = missing_in(parts, samples);
    return (samples.last - samples.first) - (missing.last - missing.first);
}

double seconds_of_samples(const std::vector<Part>& parts, int64_t& samples) {
    double seconds = 0;
    for (const Part& part : parts) {
        seconds += part.seconds;
        samples += part.samples.last - part.samples.first;
    }
    return seconds;
}

} // namespace

PlanStatus status_of(const std::filesystem::path& folder, const RenderPlan& plan) {
    PlanStatus status;
    status.tasks = int64_t(plan.tasks.size());
    const std::vector<int64_t> planned = planned_samples(plan);
    int64_t measured_samples = 0;
    double measured_seconds = 0;
    for (size_t i = 0; i < plan.looks.size(); ++i) {
        status.looks.push_back(look_progress(folder, plan, i, planned[i]));
        measured_seconds += seconds_of_samples(status.looks.back().parts, measured_samples);
        if (!plan.in_rounds() || plan.looks[i].finished) continue;
        ++status.unfinished;
        // Known before their tasks are: the samples behind the pilot.
        if (plan.error == 0) status.planned += plan.spp - planned[i];
    }
    status.seconds = measured_seconds;
    for (size_t i = 0; i < plan.tasks.size(); ++i) {
        const PlanTask& task = plan.tasks[i];
        const int64_t all = task.samples.last - task.samples.first, there = held(status.looks[task.look].parts, task.samples);
        status.planned += all;
        status.samples += there;
        if (there == all) continue;
        status.missing.push_back(i + 1);
        const TaskState state = task_state(folder, i + 1);
        if (state.running) ++status.running;
        if (state.begun && !state.running) {
            // A process that was killed leaves the line with which it began.
            const bool silent = state.last_line.starts_with("begun");
            status.failed.push_back(
                {i + 1, plan.looks[task.look].name, silent ? "ended without a word: " + state.last_line : state.last_line});
        }
    }
    const double sample = measured_samples > 0 ? measured_seconds / double(measured_samples) : plan.costs.sample;
    const double left =
        double(status.planned - status.samples) * sample + double(status.missing.size()) * (plan.costs.start + plan.costs.write);
    status.seconds_left = left / double(std::max<int64_t>(status.running, 1));
    return status;
}

OrderedJson status_json(const std::filesystem::path& folder, const RenderPlan& plan, const PlanStatus& status) {
    const Workload work{int64_t(plan.looks.size()), plan.spp, plan.chunk};
    const std::vector<Scaling> table = scaling_table(plan.costs, work);
    OrderedJson json{{"plan", folder.string()},   {"version", plan.version},
                     {"tasks", status.tasks},     {"done", status.tasks - int64_t(status.missing.size())},
                     {"running", status.running}, {"samples", status.samples},
                     {"planned", status.planned}, {"unfinished", status.unfinished},
                     {"seconds", status.seconds}, {"seconds_left", status.seconds_left}};
    json["looks"] = OrderedJson::array();
    for (size_t i = 0; i < status.looks.size(); ++i) {
        const LookProgress& look = status.looks[i];
        json["looks"].push_back({{"name", plan.looks[i].name},
                                 {"samples", look.last},
                                 {"planned", wanted_samples(plan, look)},
                                 {"merged", look.merged_samples},
                                 {"error", look.error.empty() ? OrderedJson() : OrderedJson(look.error)}});
    }
    json["failed"] = OrderedJson::array();
    for (const FailedTask& task : status.failed)
        json["failed"].push_back({{"task", task.number}, {"look", task.look}, {"line", task.last_line}});
    json["scaling"] = {{"chunk", plan.chunk}, {"knee", knee_of(table)}, {"overhead", plan_overhead(plan.costs, work)}};
    json["scaling"]["table"] = OrderedJson::array();
    for (const Scaling& row : table)
        json["scaling"]["table"].push_back(
            {{"workers", row.workers}, {"seconds", row.seconds}, {"speedup", row.speedup}, {"efficiency", row.efficiency}});
    return json;
}

std::string status_text(const RenderPlan& plan, const PlanStatus& status) {
    std::string text =
        progress_bar(status.complete() ? 1 : status.fraction(), 0,
                     fmt::format("{} of {} tasks, {} running", status.tasks - int64_t(status.missing.size()), status.tasks, status.running),
                     80) +
        "\n";
    if (status.missing.empty() && status.unfinished > 0)
        text += fmt::format("the round is done; looks that are not finished: {}; `blush plan resume` begins the next round\n",
                            status.unfinished);
    else if (!status.complete())
        text += fmt::format("about {} left {}\n", duration_text(status.seconds_left),
                            status.running > 0 ? "with the workers that run now" : "for one worker");
    for (size_t i = 0; i < std::min(status.looks.size(), shown_looks); ++i) {
        const LookProgress& look = status.looks[i];
        text += fmt::format("{:<32} {:>8} of {} samples", plan.looks[i].name, look.last, wanted_samples(plan, look));
        if (look.merged_samples > 0)
            text += fmt::format(", merged to {}, error {}", look.merged_samples, look.error.empty() ? "not known" : look.error);
        text += "\n";
    }
    if (status.looks.size() > shown_looks) text += fmt::format("and {} more looks\n", status.looks.size() - shown_looks);
    for (size_t i = 0; i < std::min(status.failed.size(), shown_failures); ++i)
        text += fmt::format("task {} of {}: {}\n", status.failed[i].number, status.failed[i].look, status.failed[i].last_line);
    if (status.failed.size() > shown_failures) text += fmt::format("and {} more failed tasks\n", status.failed.size() - shown_failures);
    return text;
}

} // namespace blush
