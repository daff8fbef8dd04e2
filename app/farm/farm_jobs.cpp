#include "app/farm/farm_jobs.h"

#include "app/common/catch_as_result.h"
#include "app/common/run_program.h"
#include "app/farm/plan_activity.h"
#include "core/text.h"

#include <chrono>
#include <thread>

namespace blush {
namespace {

Error failure(const std::filesystem::path& folder, const std::string& what, const std::filesystem::path& log) {
    const std::string words = last_words(log);
    return Error{.file = folder.string(), .what = words.empty() ? what : words};
}

} // namespace

bool has_slurm() { return run_program({"/bin/sh", "-c", "command -v sbatch >/dev/null"}) == 0; }

Result<void> make_farm_plan(const FarmChoices& choices, FarmSource source, const std::optional<SnapshotJob>& view,
                            const std::atomic<bool>& cancelled) {
    std::error_code code;
    std::filesystem::create_directories(source.folder, code);
    if (code) return Error{.file = source.folder.string(), .what = "cannot be created: " + code.message()};
    const auto make = [&]() -> Result<void> {
        if (view) {
            SnapshotJob job = *view;
            job.file = source.folder / "view.exr";
            job.film = false;
            if (const Result<SavedSnapshot> written = write_snapshot_exr(job); !written) return written.error();
            source.snapshots.push_back(job.file.string());
        }
        std::vector<std::string> words = plan_arguments(choices, source);
        words.insert(words.begin(), "/proc/self/exe");
        const std::filesystem::path log = source.folder / "plan.log";
        if (run_program(words, {log, &cancelled}) != 0) return failure(source.folder, "the plan cannot be made", log);
        std::filesystem::remove(log, code);
        return {};
    };
    const Result<void> made = catch_as_result<void>(make);
    if (!made) std::filesystem::remove_all(source.folder, code);
    return made;
}

Result<void> start_farm_plan(const std::filesystem::path& folder, const FarmChoices& choices) {
    if (choices.where == FarmChoices::Where::slurm) {
        std::vector<std::string> words{(folder / "submit-slurm.sh").string()};
        for (const std::string_view option : split(choices.slurm_options, ' '))
            if (!option.empty()) words.emplace_back(option);
        if (run_program(words, {folder / slurm_log}) == 0) return {};
        return failure(folder, "cannot be submitted to Slurm; see " + std::string(slurm_log), folder / slurm_log);
    }
    // In a session of its own, so that it goes on when the window or its terminal is closed.
    std::vector<std::string> words{
        "/bin/sh",       "-c",     "cd \"$1\" && log=$2 && shift 2 && exec setsid -f ./run-local.sh \"$@\" >\"$log\" 2>&1", "sh",
        folder.string(), local_log};
    if (choices.processes > 0) words.insert(words.end(), {"--jobs", std::to_string(choices.processes)});
    const std::optional<int> code = run_program(words);
    if (code != 0) return Error{.file = folder.string(), .what = "run-local.sh cannot be started"};
    // It runs when it holds its lock.
    for (int i = 0; i < 100 && !runs_here(folder); ++i) {
        if (!last_words(folder / local_log).empty()) return failure(folder, "", folder / local_log);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return {};
}

Result<void> stop_farm_plan(const std::filesystem::path& folder) {
    if (run_program({(folder / "stop.sh").string()}) == 0) return {};
    return Error{.file = folder.string(), .what = "cannot be stopped: run stop.sh in its folder to see why"};
}

} // namespace blush
