#include "app/commands/lesson/lesson.h"

#include "app/commands/common.h"
#include "app/commands/interrupt.h"
#include "app/commands/lesson/claims.h"
#include "app/commands/lesson/states.h"
#include "app/commands/progress.h"
#include "app/common/assets_dir.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>

namespace blush {
namespace {

struct LessonCommand {
    std::string file;
    bool claims = false, quiet = false;
    unsigned threads = 0;
};

// The number of claims that do not hold.
int check_claims(const LessonCommand& c, const Lesson& lesson, const std::vector<Project>& states, const std::atomic<bool>& interrupted) {
    int wrong = 0;
    for (size_t i = 0; i < states.size(); ++i)
        for (const LessonClaim& claim : lesson.steps[i].claims) {
            const MeasuredClaim m = measure_claim(lesson.steps[i], states[i], claim, c.threads, [&] { return !interrupted; });
            const bool holds = m.verdict == ClaimVerdict::holds;
            wrong += !holds;
            const char* verdict = holds ? "holds" : m.verdict == ClaimVerdict::fails ? "is wrong" : "is not decided";
            const std::string line = fmt::format("{}:{}: \"{}\" {}: {}", c.file, claim.line + 1, claim.says, verdict, claim_text(claim, m));
            if (!holds) fmt::print(stderr, "{}\n", line);
            if (holds && !c.quiet) fmt::print("{}\n", line);
            if (interrupted) return wrong;
        }
    return wrong;
}

int run_check(const LessonCommand& c) {
    const InterruptGuard guard;
    const Result<Lesson> lesson = read_lesson(c.file, assets_dir() / "scenes");
    if (!lesson) return failed(lesson.error());
    Result<std::vector<Project>> states = [&] {
        Progress progress(c.quiet);
        return states_of(*lesson, progress, guard.interrupted());
    }();
    if (!states) return failed(states.error());
    size_t claims = 0;
    for (const LessonStep& step : lesson->steps) claims += step.claims.size();
    if (c.claims)
        if (const int wrong = check_claims(c, *lesson, *states, guard.interrupted()); wrong > 0)
            return failed({.file = c.file, .what = fmt::format("{} of {} claims do not hold", wrong, claims)});
    if (!c.quiet)
        fmt::print("{}: \"{}\", {} steps, {} claims{}\n", c.file, lesson->title, lesson->steps.size(), claims,
                   c.claims ? ", all hold" : "; --claims measures them");
    return exit_done;
}

} // namespace

void add_lesson_command(CLI::App& app, std::function<int()>& run) {
    const auto command = std::make_shared<LessonCommand>();
    CLI::App* sub = app.add_subcommand("lesson", "Check lessons that the window shows");
    sub->require_subcommand(1);
    CLI::App* check = sub->add_subcommand("check", "Check that a lesson is valid, and with --claims that its numbers are true");
    check->add_option("file", command->file, "Lesson (.md)")->required()->type_name("FILE");
    check->add_flag("--claims", command->claims, "Measure each claim of the lesson with the renderer");
    check->add_option("--threads", command->threads, "Number of threads [one per core]")->type_name("N");
    check->add_flag("--quiet", command->quiet, "Print only errors");
    check->callback([command, &run] { run = [command] { return run_check(*command); }; });
}

} // namespace blush
