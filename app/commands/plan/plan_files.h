// The files of a plan beside plan.json: lists of commands for any scheduler, scripts for this machine and for Slurm, an explanation.
#pragma once

#include "app/commands/plan/render_plan.h"

namespace blush {

// A word of a POSIX shell that means this text.
std::string shell_quoted(const std::string& text);

// The command of a task (1 ..), and that which merges a look. Self-contained: absolute names, one line.
std::string task_command(const std::filesystem::path& folder, const RenderPlan& plan, size_t number);
std::string merge_command(const std::filesystem::path& folder, const RenderPlan& plan, const PlanLook& look);

// Writes commands.txt, merge.txt, README.txt, run-local.sh, submit-slurm.sh and its jobs, slurm-*.sh. `folder` is absolute.
Result<void> write_plan_files(const std::filesystem::path& folder, const RenderPlan& plan);
// Writes missing.txt: the commands of these tasks.
Result<void> write_missing(const std::filesystem::path& folder, const RenderPlan& plan, const std::vector<size_t>& numbers);

} // namespace blush
