// Makes plans, starts and stops them: other processes, which outlive the window. All functions wait, so they are for other threads.
#pragma once

#include "app/editor/editor_snapshot.h"
#include "app/farm/plan_arguments.h"
#include "core/result.h"

#include <atomic>
#include <optional>

namespace blush {

// True if sbatch is installed.
bool has_slurm();

// Runs `blush plan` with this program in a new folder, source.folder. `view`: written into the folder first, and added to
// source.snapshots. Errors: as of the command. Then, and if it is cancelled, the folder is removed.
Result<void> make_farm_plan(const FarmChoices& choices, FarmSource source, const std::optional<SnapshotJob>& view,
                            const std::atomic<bool>& cancelled);

// Runs run-local.sh or submit-slurm.sh. Errors: the script cannot be started, Slurm refuses the jobs.
Result<void> start_farm_plan(const std::filesystem::path& folder, const FarmChoices& choices);
// Runs stop.sh.
Result<void> stop_farm_plan(const std::filesystem::path& folder);

} // namespace blush
