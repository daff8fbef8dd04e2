#include "app/commands/plan/plan_files.h"

#include "core/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

// What a task asks of Slurm: the pilot ran on one machine, and others may be slower.
int64_t asked_minutes(const RenderPlan& plan) {
    const MeasuredCosts& c = plan.costs;
    const double task = c.start + double(std::min(plan.chunk, plan.spp)) * c.sample + c.write;
    const double merge = double((plan.spp + plan.chunk - 1) / plan.chunk) * c.read + c.write;
    return int64_t(std::ceil(std::clamp(3 * std::max(task, merge) / 60, 0.0, 1e6))) + 10;
}
int64_t asked_mib(const RenderPlan& plan) { return int64_t(std::ceil(std::clamp(1.25 * plan.costs.memory_mib, 0.0, 1e9))) + 256; }

constexpr const char* job_script = R"sh(#!/bin/sh
# One element of a job array: runs line FIRST + SLURM_ARRAY_TASK_ID of LIST.
#
#   slurm-job.sh LIST FIRST
set -eu
command=$(sed -n "$(($2 + SLURM_ARRAY_TASK_ID))p" "$1")
[ -n "$command" ] || {
    echo "slurm-job.sh: $1 has no line $(($2 + SLURM_ARRAY_TASK_ID))" >&2
    exit 1
}
# As this process, so that SIGTERM reaches Blush: it writes the samples so far.
eval "exec $command --quiet --threads ${SLURM_CPUS_PER_TASK:-${SLURM_CPUS_ON_NODE:-1}}"
)sh";

std::string sheet_script(const std::filesystem::path& folder, const RenderPlan& plan) {
    return fmt::format(
        "#!/bin/sh\n# Merges what is complete and not merged yet, then makes the contact sheet and films.\nexec {} plan merge {}\n",
        plan.program, shell_quoted(folder.string()));
}

std::string replaced(std::string text, std::string_view what, const std::string& with) {
    for (size_t at = text.find(what); at != text.npos; at = text.find(what, at + with.size())) text.replace(at, what.size(), with);
    return text;
}

std::string local_script(const std::filesystem::path& folder, const RenderPlan& plan) {
    constexpr const char* text = R"sh(#!/bin/sh
# Renders on this machine what is missing of this plan, round after round, then makes the contact sheet. While tasks run, it merges what
# there is, so that images improve. Run it again whenever something is missing. SIGTERM ends it: tasks keep their samples so far.
#
#   ./run-local.sh [--jobs N] [--merge-every SECONDS]
#
# N processes share the processors; without it one for each socket. The process id is in local.pid while it runs.
set -eu
cd @FOLDER@
jobs=$(lscpu -p=SOCKET 2>/dev/null | grep -v '^#' | sort -u | wc -l) || jobs=1
pause=20
while [ $# -gt 0 ]; do
    case $1 in
        --jobs) jobs=${2:?--jobs needs a number} ;;
        --merge-every) pause=${2:?--merge-every needs seconds} ;;
        *) echo "run-local.sh: $1 is not an option" >&2; exit 2 ;;
    esac
    shift 2
done
[ "$jobs" -gt 0 ] || jobs=1
threads=$((($(nproc) + jobs - 1) / jobs))
# Tasks inherit the lock: while one of them runs, no other script can begin.
exec 9>local.lock
# Waits a moment for those who only look whether it runs.
flock -w 1 9 || {
    echo "run-local.sh: this plan is being rendered already, see local.pid" >&2
    exit 1
}
echo $$ >local.pid

# worker K: every jobs-th line of local-tasks.txt, from line K on.
worker() {
    task=
    trap 'trap "" TERM; [ -z "$task" ] || { kill -TERM "$task" 2>/dev/null; wait "$task"; }; exit 143' TERM
    line=$1
    while command=$(sed -n "${line}p" local-tasks.txt) && [ -n "$command" ]; do
        eval "$command --quiet --threads $threads &"
        task=$!
        wait "$task" || :
        task=
        line=$((line + jobs))
    done
}
merger() {
    while sleep "$pause"; do
        begun=$(date +%s)
        @PROGRAM@ plan merge . --partial --quiet || :
        # At most a twentieth of the time goes into merging.
        sleep $((20 * ($(date +%s) - begun)))
    done
}
pids=
stop() {
    trap '' TERM INT HUP
    for pid in $pids; do kill -TERM "$pid" 2>/dev/null || :; done
    wait
    rm -f local.pid
    exit 143
}
trap stop TERM INT
trap 'rm -f local.pid' EXIT

: >local-round.txt
while @PROGRAM@ plan resume . --quiet && [ -s missing.txt ]; do
    cmp -s missing.txt local-round.txt && {
        echo "run-local.sh: the last round has rendered nothing; see blush plan status" >&2
        exit 1
    }
    cp missing.txt local-round.txt
    cp missing.txt local-tasks.txt
    pids=
    k=1
    while [ "$k" -le "$jobs" ]; do
        worker "$k" &
        pids="$pids $!"
        k=$((k + 1))
    done
    workers=$pids
    # Not the lock: a pause must not outlast the script.
    merger >/dev/null 2>&1 9>&- &
    merges=$!
    pids="$pids $merges"
    for pid in $workers; do wait "$pid" || :; done
    kill "$merges" 2>/dev/null || :
    wait "$merges" || :
done
@PROGRAM@ plan merge .
)sh";
    return replaced(replaced(text, "@PROGRAM@", plan.program), "@FOLDER@", shell_quoted(folder.string()));
}

std::string stop_script(const std::filesystem::path& folder) {
    constexpr const char* text = R"sh(#!/bin/sh
# Stops what runs of this plan: run-local.sh on this machine, and its jobs in Slurm. Tasks keep their samples so far.
set -eu
cd @FOLDER@
# run-local.sh and its tasks hold this lock: only then the number in local.pid is that of the script.
if [ -e local.lock ] && ! flock -n local.lock true; then
    kill -TERM "$(cat local.pid)" || :
fi
if [ -d slurm ] && command -v scancel >/dev/null; then
    squeue --noheader --format='%F %Z' | while read -r job folder; do
        [ "$folder" != @FOLDER@ ] || echo "$job"
    done | sort -u | xargs -r scancel
fi
)sh";
    return replaced(text, "@FOLDER@", shell_quoted(folder.string()));
}

std::string submit_script(const std::filesystem::path& folder, const RenderPlan& plan) {
    constexpr const char* text = R"sh(#!/bin/sh
# Submits to Slurm what is missing of this plan, as job arrays, and after them the merges. Run it again whenever something is missing.
#
#   ./submit-slurm.sh [options of sbatch, such as --partition=farm --cpus-per-task=16]
#
# Time and memory are from a short render on the machine that made the plan, with reserve; options given here override them.
set -eu
cd @FOLDER@
@PROGRAM@ plan resume . --quiet
@ROUNDS@count=$(wc -l <missing.txt)
mkdir -p slurm
# Slurm limits the index of an array: longer lists are several arrays.
limit=$(scontrol show config 2>/dev/null | sed -n 's/^MaxArraySize *= *\([0-9]*\).*/\1/p')
most=$((${limit:-1001} - 1))

# submit LIST COUNT [options of sbatch]: prints ids of the arrays, each after a colon.
submit() {
    list=$1 left=$2 first=0
    shift 2
    while [ "$left" -gt 0 ]; do
        size=$((left < most ? left : most))
        id=$(sbatch --parsable --array="1-$size" --requeue --open-mode=append --signal=B:TERM@60 --time=@MINUTES@ --mem=@MIB@M \
            --chdir=@FOLDER@ --output=@FOLDER@/slurm/%A_%a.out "$@" @FOLDER@/slurm-job.sh "$list" "$first")
        printf ':%s' "${id%%;*}"
        first=$((first + size))
        left=$((left - size))
    done
}

jobs=
if [ "$count" -gt 0 ]; then
    # A copy: the next run writes missing.txt again while these jobs wait.
    list=$(mktemp @FOLDER@/slurm/tasks.XXXXXX)
    cp missing.txt "$list"
    jobs=$(submit "$list" "$count" --job-name=@NAME@ "$@")
    echo "tasks: $count in job${jobs}"
fi
merges=$(submit @FOLDER@/merge.txt "$(wc -l <merge.txt)" --job-name=@NAME@-merge ${jobs:+--dependency=afterany$jobs} "$@")
echo "merges: $(wc -l <merge.txt) in job${merges}"
# Last the overview: a contact sheet, and films of sequences.
sheet=$(sbatch --parsable --job-name=@NAME@-sheet --dependency=afterany$merges --requeue --open-mode=append --time=@MINUTES@ \
    --mem=@MIB@M --chdir=@FOLDER@ --output=@FOLDER@/slurm/%j.out "$@" @FOLDER@/slurm-sheet.sh)
echo "contact sheet: job ${sheet%%;*}"
)sh";
    std::string script = text;
    const auto replace = [&](std::string_view what, const std::string& with) { script = replaced(std::move(script), what, with); };
    std::string rounds;
    if (plan.in_rounds()) {
        rounds = "# `plan resume` decides after each round whether there is another one. Nothing new means the end, or tasks that fail.\n"
                 "if [ ! -s missing.txt ] || cmp -s missing.txt slurm/round.txt; then\n"
                 "    echo \"no new tasks\"\n"
                 "    exec @PROGRAM@ plan merge .\n"
                 "fi\n"
                 "mkdir -p slurm\n"
                 "cp missing.txt slurm/round.txt\n";
        script +=
            "sbatch --parsable --job-name=@NAME@-next --dependency=afterany$merges --time=@MINUTES@ --output=@FOLDER@/slurm/next.out \\\n"
            "    \"$@\" @FOLDER@/submit-slurm.sh \"$@\"\n";
    }
    replace("@ROUNDS@", rounds);
    replace("@PROGRAM@", plan.program);
    replace("@NAME@", "blush");
    replace("@MINUTES@", std::to_string(asked_minutes(plan)));
    replace("@MIB@", std::to_string(asked_mib(plan)));
    replace("@FOLDER@", shell_quoted(folder.string())); // last: its text is not searched for the others
    return script;
}

std::string explanation(const RenderPlan& plan) {
    const std::string until = plan.error > 0 ? fmt::format("until the error is {:g}, at most {} samples per pixel", plan.error, plan.spp)
                                             : fmt::format("{} samples per pixel", plan.spp);
    return fmt::format("A render plan of blush {}. Looks: {}, {}. Tasks: {} of {} samples.\n"
                       "\n"
                       "plan.json        what is rendered: scenes and their hashes, looks, tasks, measured costs, the scaling table\n"
                       "commands.txt     one command a line, in any order, on any machine that sees this folder and the scenes; running "
                       "one again is free\n"
                       "missing.txt      those whose samples are missing, as of the last `blush plan resume`\n"
                       "merge.txt        one command a line, per look, after the tasks\n"
                       "run-local.sh     renders what is missing on this machine, and merges\n"
                       "submit-slurm.sh  submits what is missing and then the merges to Slurm; slurm-*.sh are its jobs\n"
                       "stop.sh          stops what runs here or in Slurm; samples so far are kept\n"
                       "scenes           copies of the scenes, if they were gathered\n"
                       "parts            sums of samples; logs, one per task; merged, the images; allocations, of adaptive sampling\n"
                       "\n"
                       "On this machine, until it is done:           ./run-local.sh\n"
                       "How it stands:                               blush plan status DIR --watch\n"
                       "What is missing, as a list of commands:      blush plan resume DIR\n",
                       plan.version, plan.looks.size(), until, plan.tasks.size(), plan.chunk);
}

Result<void> write_script(const std::filesystem::path& file, const std::string& text) {
    if (const Result<void> written = write_file(file, text); !written) return written;
    std::error_code code;
    using std::filesystem::perms;
    std::filesystem::permissions(file, perms::owner_exec | perms::group_exec | perms::others_exec, std::filesystem::perm_options::add,
                                 code);
    return code ? Result<void>(Error{.file = file.string(), .what = "cannot be made executable"}) : Result<void>();
}

} // namespace

std::string shell_quoted(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

std::string task_command(const std::filesystem::path& folder, const RenderPlan& plan, size_t number) {
    return fmt::format("{} plan run {} {}", plan.program, shell_quoted(folder.string()), number);
}

std::string merge_command(const std::filesystem::path& folder, const RenderPlan& plan, const PlanLook& look) {
    return fmt::format("{} plan merge {} {}", plan.program, shell_quoted(folder.string()), look.name);
}

Result<void> write_plan_files(const std::filesystem::path& folder, const RenderPlan& plan) {
    std::string commands, merges;
    for (size_t i = 0; i < plan.tasks.size(); ++i) commands += task_command(folder, plan, i + 1) + "\n";
    for (const PlanLook& look : plan.looks) merges += merge_command(folder, plan, look) + "\n";
    if (const Result<void> written = write_file(folder / "commands.txt", commands); !written) return written;
    if (const Result<void> written = write_file(folder / "merge.txt", merges); !written) return written;
    if (const Result<void> written = write_file(folder / "README.txt", explanation(plan)); !written) return written;
    if (const Result<void> written = write_script(folder / "slurm-job.sh", job_script); !written) return written;
    if (const Result<void> written = write_script(folder / "slurm-sheet.sh", sheet_script(folder, plan)); !written) return written;
    if (const Result<void> written = write_script(folder / "run-local.sh", local_script(folder, plan)); !written) return written;
    if (const Result<void> written = write_script(folder / "stop.sh", stop_script(folder)); !written) return written;
    return write_script(folder / "submit-slurm.sh", submit_script(folder, plan));
}

Result<void> write_missing(const std::filesystem::path& folder, const RenderPlan& plan, const std::vector<size_t>& numbers) {
    std::string commands;
    for (const size_t number : numbers) commands += task_command(folder, plan, number) + "\n";
    return write_file(folder / "missing.txt", commands);
}

} // namespace blush
