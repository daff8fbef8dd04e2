#include "app/commands/lesson/lesson.h"

#include "app/commands/common.h"
#include "app/commands/interrupt.h"
#include "app/commands/lesson/claims.h"
#include "app/commands/lesson/handout.h"
#include "app/commands/lesson/states.h"
#include "app/commands/progress.h"
#include "app/commands/render/write_image.h"
#include "app/common/assets_dir.h"
#include "core/files.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace blush {
namespace {

struct LessonCommand {
    std::string file;
    bool claims = false, no_claims = false, quiet = false;
    unsigned threads = 0;
    std::string output; // of the handout
    HandoutOptions handout;
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

struct Opened {
    Lesson lesson;
    std::vector<Project> states; // of its steps
};

Result<Opened> opened(const LessonCommand& c, const std::atomic<bool>& interrupted) {
    Result<Lesson> lesson = read_lesson(c.file, assets_dir() / "scenes");
    if (!lesson) return lesson.error();
    Progress progress(c.quiet);
    Result<std::vector<Project>> states = states_of(*lesson, progress, interrupted);
    if (!states) return states.error();
    return Opened{*std::move(lesson), *std::move(states)};
}

int run_check(const LessonCommand& c) {
    const InterruptGuard guard;
    const Result<Opened> found = opened(c, guard.interrupted());
    if (!found) return failed(found.error());
    const auto& [lesson, states] = *found;
    size_t claims = 0;
    for (const LessonStep& step : lesson.steps) claims += step.claims.size();
    if (c.claims)
        if (const int wrong = check_claims(c, lesson, states, guard.interrupted()); wrong > 0)
            return failed({.file = c.file, .what = fmt::format("{} of {} claims do not hold", wrong, claims)});
    if (!c.quiet)
        fmt::print("{}: \"{}\", {} steps, {} claims{}\n", c.file, lesson.title, lesson.steps.size(), claims,
                   c.claims ? ", all hold" : "; --claims measures them");
    return exit_done;
}

int run_export(LessonCommand c) {
    if (const std::string extension = lower_extension(c.output); extension != ".html" && extension != ".htm")
        return bad_usage(fmt::format("\"{}\" must end in .html or .htm", c.output));
    if (const Result<void> folder = expect_folder(c.output); !folder) return failed(folder.error());
    const Result<ColorManagement> color = ColorManagement::load(assets_dir());
    if (!color) return failed(color.error());
    const InterruptGuard guard;
    const Result<Opened> found = opened(c, guard.interrupted());
    if (!found) return failed(found.error());
    c.handout.threads = c.threads;
    c.handout.claims = !c.no_claims;
    const Result<std::vector<HandoutStep>> steps = [&] {
        Progress progress(c.quiet);
        return measure_handout(found->lesson, found->states, c.handout, *color, progress, guard.interrupted());
    }();
    if (!steps) return failed(in_file(steps.error(), c.file));
    if (const Result<void> written = write_file(c.output, handout_html(found->lesson, *steps)); !written) return failed(written.error());
    size_t claims = 0, hold = 0;
    for (const HandoutStep& step : *steps) {
        claims += step.claims.size();
        hold += size_t(std::ranges::count(step.claims, ClaimVerdict::holds, &MeasuredClaim::verdict));
    }
    if (!c.quiet)
        fmt::print("{}: \"{}\", {} steps{}\n", c.output, found->lesson.title, steps->size(),
                   c.handout.claims ? fmt::format(", {} of {} claims hold", hold, claims) : "");
    return exit_done;
}

void add_shared_options(CLI::App& sub, const std::shared_ptr<LessonCommand>& command) {
    sub.add_option("file", command->file, "Lesson (.md)")->required()->type_name("FILE");
    sub.add_option("--threads", command->threads, "Number of threads [one per core]")->type_name("N");
    sub.add_flag("--quiet", command->quiet, "Print only errors");
}

} // namespace

void add_lesson_command(CLI::App& app, std::function<int()>& run) {
    const auto command = std::make_shared<LessonCommand>();
    CLI::App* sub = app.add_subcommand("lesson", "Check lessons that the window shows, and print them");
    sub->require_subcommand(1);
    CLI::App* check = sub->add_subcommand("check", "Check that a lesson is valid, and with --claims that its numbers are true");
    add_shared_options(*check, command);
    check->add_flag("--claims", command->claims, "Measure each claim of the lesson with the renderer");
    check->callback([command, &run] { run = [command] { return run_check(*command); }; });

    CLI::App* handout =
        sub->add_subcommand("export", "Write a lesson with its pictures, error curves and measured claims as one HTML file");
    add_shared_options(*handout, command);
    HandoutOptions& h = command->handout;
    handout->add_option("-o,--output", command->output, "HTML file; needs nothing but itself")->required()->type_name("FILE");
    handout->add_option("--size", h.size, fmt::format("Longer side of each picture in pixels [{}]", h.size))
        ->check(CLI::Range(least_handout_size, most_handout_size))
        ->type_name("N");
    CLI::Option* spp = handout->add_option("--spp", h.spp, fmt::format("Samples per pixel [those of the step, or else {}]", h.spp));
    spp->check(CLI::Range(int64_t(1), int64_t(1) << 20))->type_name("N");
    handout->add_flag("--no-claims", command->no_claims, "Do not measure the claims");
    handout->callback([command, spp, &run] {
        command->handout.spp_given = spp->count() > 0;
        run = [command] { return run_export(*command); };
    });
}

} // namespace blush
