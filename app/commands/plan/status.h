// `blush plan status DIR`: how far a plan is.
#pragma once

#include "app/commands/json_output.h"
#include "app/commands/plan/merge_looks.h"

#include <string>
#include <vector>

namespace blush {

// A task that is not done and does not run, although it has begun.
struct FailedTask {
    size_t number = 0;
    std::string look;
    std::string last_line; // of its log
};

struct PlanStatus {
    std::vector<LookProgress> looks;
    std::vector<size_t> missing; // numbers of the tasks whose samples are not all there
    int64_t tasks = 0, running = 0;
    int64_t samples = 0, planned = 0; // of all looks
    double seconds = 0;               // of rendering, of the parts that count
    double seconds_left = 0;          // on the workers that run now, or on one
    std::vector<FailedTask> failed;
    int64_t unfinished = 0; // looks of a plan in rounds for which another round may follow
    double fraction() const { return planned > 0 ? double(samples) / double(planned) : 0; }
    bool complete() const { return missing.empty() && unfinished == 0; }
};

PlanStatus status_of(const std::filesystem::path& folder, const RenderPlan& plan);

// {plan, version, tasks, done, running, samples, planned, unfinished, seconds_left, looks: [{name, samples, planned, merged, error}],
// failed:
// [{task, look, line}], scaling: {chunk, knee, overhead, table: [{workers, seconds, speedup, efficiency}]}}
OrderedJson status_json(const std::filesystem::path& folder, const RenderPlan& plan, const PlanStatus& status);
// Several lines for a terminal.
std::string status_text(const RenderPlan& plan, const PlanStatus& status);

} // namespace blush
