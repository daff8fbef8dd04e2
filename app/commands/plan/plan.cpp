#include "app/commands/plan/plan.h"

#include "app/commands/common.h"
#include "app/commands/interrupt.h"
#include "app/commands/plan/contact_sheet.h"
#include "app/commands/plan/film.h"
#include "app/commands/plan/make_plan.h"
#include "app/commands/plan/plan_files.h"
#include "app/commands/plan/resume.h"
#include "app/commands/plan/run_task.h"
#include "app/commands/progress.h"
#include "app/commands/render/write_image.h"
#include "core/text.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <memory>
#include <thread>

namespace blush {
namespace {

struct PlanCommand {
    std::vector<std::string> what; // scenes, or a verb and its arguments
    PlanInput input;
    std::string output, chunk = "auto", program;
    bool watch = false, partial = false;
    std::vector<std::string> given; // long names of the options on the command line
    CommonOptions common;

    RenderRun render_run() const { return {common.threads, common.quiet}; }
    bool prints() const { return !common.quiet && common.json != "-"; }
};

// What each verb accepts besides the common options.
struct Verb {
    const char* name;
    size_t least, most; // arguments after it
    std::vector<std::string> options;
    const char* usage;
};
const std::array<Verb, 4>& verbs() {
    constexpr size_t any = size_t(-1);
    static const std::array<Verb, 4> all{{{"run", 2, 2, {}, "plan run needs DIR TASK"},
                                          {"merge", 1, any, {"partial"}, "plan merge needs DIR [LOOK...]"},
                                          {"status", 1, 1, {"watch"}, "plan status needs DIR"},
                                          {"resume", 1, 1, {}, "plan resume needs DIR"}}};
    return all;
}
const Verb* verb_of(const PlanCommand& c) {
    const auto found = std::ranges::find_if(verbs(), [&](const Verb& v) { return !c.what.empty() && c.what.front() == v.name; });
    return found == verbs().end() ? nullptr : &*found;
}

// Errors: arguments or options that this verb does not have.
Result<void> check_usage(const PlanCommand& c, const Verb* verb) {
    if (verb && (c.what.size() - 1 < verb->least || c.what.size() - 1 > verb->most)) return Error{.what = verb->usage};
    for (const std::string& name : c.given) {
        const bool common = name == "json" || name == "threads" || name == "quiet";
        if (verb && !common && std::ranges::find(verb->options, name) == verb->options.end())
            return Error{.what = fmt::format("blush plan {} has no --{}", verb->name, name)};
        if (!verb && (name == "watch" || name == "partial")) return Error{.what = fmt::format("--{} is not for making a plan", name)};
    }
    return {};
}

// ---- making

bool has_control_character(const std::string& text) {
    return std::ranges::any_of(text, [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

Result<void> complete_input(PlanCommand& c) {
    PlanInput& input = c.input;
    input.scenes = c.what;
    if (c.output.empty()) return Error{.what = "plan needs -o DIR"};
    if (input.scenes.empty() && input.snapshots.empty()) return Error{.what = "plan needs a SCENE or --snapshots"};
    for (const char* unwanted : {"time", "samples", "denoise"})
        if (std::ranges::find(c.given, unwanted) != c.given.end()) return Error{.what = fmt::format("--{} cannot be planned", unwanted)};
    if (has_control_character(c.program)) return Error{.what = "--program must be one line"};
    if (!(input.frames_per_second >= 0.01 && input.frames_per_second <= 1000)) return Error{.what = "--fps must be from 0.01 to 1000"};
    if (!input.frames.empty() && input.turntable > 0) return Error{.what = "--frames and --turntable exclude each other"};
    // Off unless asked for: it needs a second round.
    input.options.settings.adaptive &= input.options.adaptive_given;
    if (const Result<RenderSettings> settings = settings_of(input.options); !settings) return settings.error();
    const Result<Layers> layers = parse_layers(input.layers);
    if (!layers) return layers.error();
    if (!layers->film) input.layers += ",film";
    if (int64_t number = 0; c.chunk != "auto") {
        if (!parse_number(c.chunk, number) || number < 1 || number > (int64_t(1) << 40) || (number & (number - 1)) != 0)
            return Error{.what = fmt::format("--chunk must be auto or a power of two, not \"{}\"", c.chunk)};
        input.chunk = number;
    }
    return {};
}

// Absolute names, which stay on one line of a list of commands.
Result<std::filesystem::path> new_folder(const std::string& output) {
    std::error_code code;
    std::filesystem::create_directories(output, code);
    const std::filesystem::path folder = std::filesystem::canonical(output, code);
    if (code || !std::filesystem::is_directory(folder, code)) return Error{.file = output, .what = "is not a folder and cannot be created"};
    if (std::filesystem::exists(folder / "plan.json", code))
        return Error{.file = output, .what = "has a plan already; see blush plan resume"};
    if (has_control_character(folder.string()))
        return Error{.file = output, .what = "has a control character in its name, which no list of commands can hold"};
    return folder;
}

std::string own_program() {
    std::error_code code;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", code);
    return code ? "blush" : shell_quoted(program.string());
}

void print_plan(const PlanCommand& c, const RenderPlan& plan) {
    const Workload work{int64_t(plan.looks.size()), plan.spp, plan.chunk};
    const std::vector<Scaling> table = scaling_table(plan.costs, work);
    fmt::print("{}: looks {}, tasks {} of {} samples and {:.0f} MiB, {:.1f} % more work than one process\n", c.output, plan.looks.size(),
               plan.tasks.size(), plan.chunk, plan.costs.memory_mib, 100 * plan_overhead(plan.costs, work));
    fmt::print("expected: {} on 1 worker, {} on {}; more hardly help\n", duration_text(table.front().seconds),
               duration_text(simulate(plan.costs, work, knee_of(table)).seconds), knee_of(table));
}

int run_make(PlanCommand& c) {
    if (const Result<void> complete = complete_input(c); !complete) return bad_usage(complete.error().text());
    const Result<std::filesystem::path> folder = new_folder(c.output);
    if (!folder) return failed(folder.error());
    if (const auto color = color_for(ImageFormat::display, c.input.options.view); !color) return failed(color.error());
    c.input.folder = *folder;
    c.input.program = c.program.empty() ? own_program() : c.program;
    const InterruptGuard guard;
    const Result<RenderPlan> plan = make_plan(c.input, c.render_run(), guard.interrupted());
    if (!plan) return failed(in_file(plan.error(), c.output));
    if (const Result<void> written = write_plan_files(*folder, *plan); !written) return failed(written.error());
    for (const char* inside : {"parts", "logs", "merged"})
        if (const Result<void> ready = provide_folder(*folder, *folder / inside); !ready) return failed(ready.error());
    // Last: a folder with a plan is complete.
    const PlanStatus status = status_of(*folder, *plan);
    if (const Result<void> written = write_missing(*folder, *plan, status.missing); !written) return failed(written.error());
    if (const Result<void> written = write_plan(*folder, *plan); !written) return failed(written.error());
    if (const Result<void> written = write_json(c.common.json, status_json(*folder, *plan, status)); !written)
        return failed(written.error());
    if (c.prints()) print_plan(c, *plan);
    return exit_done;
}

// ---- verbs

int run_one_task(const PlanCommand& c, const std::filesystem::path& folder) {
    size_t number = 0;
    if (!parse_number(c.what[2], number)) return bad_usage(fmt::format("a task is a number, not \"{}\"", c.what[2]));
    const Result<TaskResult> result = run_task(folder, number, c.render_run());
    if (!result) return failed(result.error());
    const SampleSpan s = result->rendered;
    const OrderedJson json{{"task", number}, {"rendered", {s.first, s.last}}, {"seconds", result->seconds}};
    if (const Result<void> written = write_json(c.common.json, json); !written) return failed(written.error());
    if (!c.prints()) return exit_done;
    if (s.first == s.last)
        fmt::print("task {}: done already\n", number);
    else
        fmt::print("task {}: samples {}:{} in {:.2f} s\n", number, s.first, s.last, result->seconds);
    return exit_done;
}

Result<std::vector<size_t>> looks_named(const RenderPlan& plan, const std::vector<std::string>& names) {
    std::vector<size_t> indices;
    for (const std::string& name : names) {
        const auto found = std::ranges::find(plan.looks, name, &PlanLook::name);
        if (found == plan.looks.end()) return Error{.what = fmt::format("the plan has no look \"{}\"", name)};
        indices.push_back(size_t(found - plan.looks.begin()));
    }
    for (size_t i = 0; names.empty() && i < plan.looks.size(); ++i) indices.push_back(i);
    return indices;
}

// Where merging and resuming write.
Result<void> provide_outputs(const std::filesystem::path& folder) {
    const Result<void> ready = provide_folder(folder, folder);
    return ready ? provide_folder(folder, folder / "merged") : ready;
}

// Display images of all that is merged, the contact sheet, and films of sequences that are complete.
Result<void> write_overview(const std::filesystem::path& folder, const RenderPlan& plan, bool prints) {
    std::vector<LookProgress> progress;
    const std::vector<int64_t> planned = planned_samples(plan);
    std::map<std::string, bool> complete; // by sequence
    for (size_t i = 0; i < plan.looks.size(); ++i) {
        progress.push_back(look_progress(folder, plan, i, planned[i]));
        if (const std::string& sequence = plan.looks[i].sequence; !sequence.empty())
            complete[sequence] = complete.try_emplace(sequence, true).first->second && progress.back().merged && progress.back().complete();
    }
    if (const Result<void> sheet = write_contact_sheet(folder, plan, progress); !sheet) return sheet;
    for (const auto& [sequence, all] : complete) {
        if (!all) continue;
        const Result<bool> film = write_film(folder, plan, sequence);
        if (!film) return film.error();
        if (!*film && prints) fmt::print(stderr, "blush: note: there is no ffmpeg for a film of {}\n", sequence);
    }
    return {};
}

// Merges what is complete; with --partial, what there is. The overview needs all looks, so it is not made for a few of them.
int run_merges(const PlanCommand& c, const std::filesystem::path& folder, const RenderPlan& plan) {
    if (const Result<void> ready = provide_outputs(folder); !ready) return failed(ready.error());
    const Result<std::vector<size_t>> chosen = looks_named(plan, {c.what.begin() + 2, c.what.end()});
    if (!chosen) return failed(in_file(chosen.error(), folder.string()));
    const Result<std::optional<ColorManagement>> color = color_for(ImageFormat::display, plan.view);
    if (!color) return failed(color.error());
    const std::vector<int64_t> planned = planned_samples(plan);
    OrderedJson merged = OrderedJson::array();
    size_t unfinished = 0;
    for (const size_t i : *chosen) {
        const LookProgress before = look_progress(folder, plan, i, planned[i]);
        if (!before.complete()) ++unfinished;
        if (before.chain.empty() || (!before.complete() && !c.partial)) continue;
        const Result<LookProgress> look = merge_look(folder, plan, i, planned[i], c.common.threads);
        if (!look) return failed(look.error());
        std::error_code code;
        if (!before.merged || !std::filesystem::exists(display_file(folder, plan.looks[i]), code))
            if (const Result<void> shown = write_display(folder, plan, plan.looks[i], **color); !shown) return failed(shown.error());
        merged.push_back({{"name", plan.looks[i].name},
                          {"samples", look->merged_samples},
                          {"error", look->error.empty() ? OrderedJson() : OrderedJson(look->error)},
                          {"output", merged_file(folder, plan.looks[i]).string()}});
    }
    if (c.what.size() == 2)
        if (const Result<void> overview = write_overview(folder, plan, c.prints()); !overview) return failed(overview.error());
    if (const Result<void> written = write_json(c.common.json, {{"merged", merged}, {"unfinished", unfinished}}); !written)
        return failed(written.error());
    if (c.prints())
        fmt::print("{}: {} of {} looks merged, {} unfinished\n", (folder / "merged").string(), merged.size(), chosen->size(), unfinished);
    const auto waits = [](const PlanLook& look) { return !look.finished; };
    if (plan.in_rounds() && c.prints() && std::ranges::any_of(plan.looks, waits))
        fmt::print(stderr, "blush: note: another round may follow: run `blush plan resume {}`\n", c.what[1]);
    if (unfinished > 0 && !c.partial)
        return failed({.file = folder.string(),
                       .what = fmt::format("{} of {} looks lack samples; see blush plan status", unfinished, chosen->size())});
    return exit_done;
}

int run_status(const PlanCommand& c, const std::filesystem::path& folder) {
    const InterruptGuard guard;
    for (;;) {
        const Result<RenderPlan> plan = read_plan(folder); // anew, since a round may have added tasks
        if (!plan) return failed(plan.error());
        const PlanStatus status = status_of(folder, *plan);
        if (const Result<void> written = write_json(c.common.json, status_json(folder, *plan, status)); !written)
            return failed(written.error());
        if (c.prints()) fmt::print("{}", status_text(*plan, status));
        std::fflush(stdout);
        if (!c.watch || status.complete() || guard.interrupted()) return exit_done;
        for (int i = 0; i < 20 && !guard.interrupted(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(100));
        if (guard.interrupted()) return exit_done;
    }
}

int run_resume(const PlanCommand& c, const std::filesystem::path& folder, RenderPlan plan) {
    if (const Result<void> ready = provide_outputs(folder); !ready) return failed(ready.error());
    const Result<Resumed> resumed = resume_plan(folder, plan, c.common.threads);
    if (!resumed) return failed(resumed.error());
    OrderedJson json = status_json(folder, plan, resumed->status);
    json["added"] = resumed->added;
    if (const Result<void> written = write_json(c.common.json, json); !written) return failed(written.error());
    if (c.prints())
        fmt::print("{}: {} tasks to run{}\n", (folder / "missing.txt").string(), resumed->status.missing.size(),
                   resumed->added > 0 ? fmt::format(", {} of them new", resumed->added) : "");
    return exit_done;
}

int run_plan(PlanCommand& c) {
    const Verb* verb = verb_of(c);
    if (const Result<void> usage = check_usage(c, verb); !usage) return bad_usage(usage.error().text());
    if (!verb) return run_make(c);
    std::error_code code;
    const std::filesystem::path folder = std::filesystem::canonical(c.what[1], code);
    if (code) return failed({.file = c.what[1], .what = "there is no such folder"});
    const std::string_view name = verb->name;
    if (name == "run") return run_one_task(c, folder);
    if (name == "status") return run_status(c, folder);
    Result<RenderPlan> plan = read_plan(folder);
    if (!plan) return failed(plan.error());
    return name == "merge" ? run_merges(c, folder, *plan) : run_resume(c, folder, *std::move(plan));
}

void add_look_options(CLI::App& sub, PlanInput& input) {
    sub.add_option("--looks", input.looks, "Looks as overrides of these options, and a matrix of them")->type_name("JSON");
    sub.add_option("--cameras", input.cameras, "One look per camera [the one of --camera]")->type_name("all|LIST");
    sub.add_option("--variants", input.variants, "One look per material variant [the one of --material-variant]")->type_name("all|LIST");
    sub.add_option("--frames", input.frames, "One look per frame of the animation, A to B, both included")->type_name("A:B[:STEP]");
    sub.add_option("--fps", input.frames_per_second, "Frames per second of --frames and of films, 0.01 to 1000 [24]")->type_name("F");
    sub.add_option("--turntable", input.turntable, "N looks around the centre of the scene, about the vertical")
        ->check(CLI::Range(1, 100000))
        ->type_name("N");
    sub.add_option("--snapshots", input.snapshots, "Snapshots of the window, as looks")->type_name("EXR");
    sub.add_flag("--gather", input.gather, "Copy the scenes into the folder, for workers that do not see the originals");
    sub.add_option("--layers", input.layers, "Layers of the images, as in render; their sums are always there")->type_name("LIST");
}

} // namespace

void add_plan_command(CLI::App& app, std::function<int()>& run) {
    const auto command = std::make_shared<PlanCommand>();
    CLI::App* sub = app.add_subcommand("plan", "Plan renders for many machines, run their tasks, and merge the results");
    sub->add_option("what", command->what, "Scenes to plan; or run DIR TASK, merge DIR [LOOK...], status DIR, resume DIR")
        ->type_name("SCENE|VERB");
    sub->add_option("-o,--output", command->output, "Folder for the plan, which must not have one")->type_name("DIR");
    sub->add_option("--chunk", command->chunk, "Samples of a task, a power of two; auto: by a measured pilot [auto]")->type_name("auto|N");
    sub->add_option("--workers", command->input.workers, "With --chunk auto: end as early as N workers can [little overhead for one]")
        ->check(CLI::Range(1, 10000))
        ->type_name("N");
    sub->add_option("--program", command->program, "How the commands of the plan call Blush [the path of this program]")
        ->type_name("COMMAND");
    add_look_options(*sub, command->input);
    sub->add_flag("--watch", command->watch, "With status: again every two seconds until all is done");
    sub->add_flag("--partial", command->partial, "With merge: also looks that lack samples, as far as they are without gap");
    add_render_options(*sub, command->input.options);
    sub->get_option("--adaptive")->description("Adaptive sampling, which takes two rounds: a pilot, then the samples it allocates [off]");
    add_common_options(*sub, command->common);
    sub->callback([command, sub, &run] {
        command->input.words = words_given(*sub);
        for (const CLI::Option* option : sub->get_options())
            if (option->count() > 0 && !option->get_lnames().empty()) command->given.push_back(option->get_lnames().front());
        run = [command] { return run_plan(*command); };
    });
}

} // namespace blush
