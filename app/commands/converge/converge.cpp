#include "app/commands/converge/converge.h"

#include "app/commands/common.h"
#include "app/commands/converge/reference_cache.h"
#include "app/commands/converge/report.h"
#include "app/commands/interrupt.h"
#include "app/commands/load_scene.h"
#include "app/commands/progress.h"
#include "app/commands/render/write_image.h"
#include "core/files.h"
#include "core/text.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace blush {
namespace {

// Samples for a reference with a quarter of a variant's RMSE, that is 1/16 of its MSE.
constexpr double reference_effort = 16;

struct ConvergeCommand {
    std::string scene, folder, preset, reference;
    std::vector<std::string> variants;
    int repeats = 4;
    RenderOptions options;
    CommonOptions common;
};

struct Plan {
    RenderSettings base;
    ConvergeInput input;
};

Result<Plan> plan_of(const ConvergeCommand& c) {
    RenderOptions options = c.options;
    if (options.samples_given) return Error{.what = "converge takes --spp or --time, not --samples"};
    if (options.denoise) return Error{.what = "converge measures raw images: --denoise is not allowed"};
    if (options.settings.error > 0) return Error{.what = "converge takes --spp or --time, not --error"};
    if (!options.spp_given && options.settings.seconds == 0) options.settings.seconds = 10;
    Plan plan;
    const Result<RenderSettings> base = settings_of(options);
    if (!base) return base.error();
    plan.base = *base;
    ConvergeInput& input = plan.input;
    input.repeats = c.repeats;
    input.seconds = base->seconds;
    input.spp = base->spp;
    input.seed = base->seed;
    input.threads = c.common.threads;
    input.whole_paths = base->max_bounces == unlimited_bounces;
    if (!c.preset.empty()) {
        Result<std::vector<Variant>> preset = preset_variants(c.preset, options);
        if (!preset) return preset.error();
        input.variants = *std::move(preset);
    }
    for (const std::string& text : c.variants) {
        Result<Variant> variant = parse_variant(text, options);
        if (!variant) return variant.error();
        input.variants.push_back(*std::move(variant));
    }
    if (input.variants.empty()) input.variants.push_back({"as given", "", plan.base, options.integrator});
    for (size_t i = 0; i < input.variants.size(); ++i)
        for (size_t j = 0; j < i; ++j)
            if (input.variants[i].name == input.variants[j].name)
                return Error{.what = fmt::format("two variants have the name \"{}\"", input.variants[i].name)};
    return plan;
}

// From --reference, from the cache (with more samples if necessary), or rendered.
Result<void> provide_reference(const ConvergeCommand& c, const Plan& plan, ConvergeReport& report, const std::atomic<bool>& interrupted) {
    if (!c.reference.empty()) {
        Result<Reference> given = read_reference_file(c.reference, plan.base.width, plan.base.height);
        if (!given) return given.error();
        report.reference = *std::move(given);
        report.reference_source = std::filesystem::path(c.reference).filename().string();
        return {};
    }
    const std::vector<uint32_t> seeds = seeds_of(plan.input);
    const std::filesystem::path folder = reference_folder();
    const std::string key = reference_key(*plan.input.scene, plan.base);
    Reference& reference = report.reference;
    if (std::optional<Reference> cached = cached_reference(folder, key, seeds))
        reference = *std::move(cached);
    else
        reference.seed = reference_seed(seeds);
    const int64_t cached_samples = reference.measured.samples;
    const ReferenceBudget budget{int64_t(reference_effort * double(plan.input.spp)), reference_effort * plan.input.seconds};
    {
        Progress progress(c.common.quiet);
        Renderer renderer({.threads = c.common.threads, .low_priority = false, .planes = {}});
        extend_reference(
            reference, renderer, *plan.input.scene, plan.base, budget, [&] { return !interrupted; },
            [&](double fraction) { progress.update(fraction, "reference"); });
    }
    if (reference.measured.samples == 0) return Error{.file = c.scene, .what = "interrupted before there was a reference"};
    report.reference_source = cached_samples == 0                           ? "rendered"
                              : reference.measured.samples > cached_samples ? "from the cache, extended"
                                                                            : "from the cache";
    // Without the cache the next run only takes longer.
    if (reference.measured.samples > cached_samples)
        if (const Result<void> cached = cache_reference(folder, key, reference); !cached && !c.common.quiet)
            fmt::print(stderr, "blush: warning: the reference could not be stored: {}\n", cached.error().text());
    return {};
}

Result<void> write_report(const ConvergeCommand& c, const ConvergeReport& report, const OrderedJson& json) {
    const std::filesystem::path folder = c.folder;
    if (const Result<void> written = write_file(folder / "convergence.csv", converge_csv(report)); !written) return written;
    if (const Result<void> written = write_json((folder / "convergence.json").string(), json); !written) return written;
    const Result<std::optional<ColorManagement>> color = color_for(ImageFormat::display, c.options.view);
    if (!color) return color.error();
    const Result<std::string> html = converge_html(report, **color, c.options.view);
    if (!html) return html.error();
    return write_file(folder / "report.html", *html);
}

void print_summary(const ConvergeCommand& c, const ConvergeReport& report) {
    for (const VariantResult& v : report.result.variants) {
        if (v.points.empty()) continue;
        const MeasuredPoint& last = v.points.back();
        fmt::print("{:<32} {:>7} spp  RMSE {:.3g}  efficiency {:.3g}  {}", v.variant.name, last.spp, last.metrics.rmse, v.efficiency.value,
                   v.bias.verdict());
        if (v.bias.biased) fmt::print(", {} %", signed_number(v.bias.whole.percent(), 2));
        if (const std::string where = bias_by_bounce_text(v); !where.empty()) fmt::print(" ({})", where);
        fmt::print("{}\n", last.reference_clearly_better ? "" : "  (the reference is not clearly better)");
    }
    fmt::print("{}/report.html{}\n", c.folder, report.result.partial ? ", partial" : "");
}

int run_converge_command(const ConvergeCommand& c) {
    Result<Plan> plan = plan_of(c);
    if (!plan) return bad_usage(plan.error().text());
    if (const auto color = color_for(ImageFormat::display, c.options.view); !color) return failed(color.error());
    std::error_code code;
    std::filesystem::create_directories(c.folder, code);
    if (code || !std::filesystem::is_directory(c.folder, code))
        return failed({.file = c.folder, .what = "is not a folder and cannot be created"});

    const InterruptGuard guard;
    const float aspect = float(plan->base.width) / float(plan->base.height);
    Result<LoadedScene> loaded = [&] {
        Progress progress(c.common.quiet);
        return load_scene(c.scene, c.options.overrides, aspect, progress, guard.interrupted());
    }();
    if (!loaded) return failed(loaded.error());
    if (!c.common.quiet) print_warnings(c.scene, loaded->report.diagnostics);
    plan->input.scene = &loaded->scene;

    ConvergeReport report;
    report.scene = std::filesystem::path(c.scene).filename().string();
    report.preset = c.preset;
    report.width = plan->base.width;
    report.height = plan->base.height;
    report.input = plan->input;
    report.machine = machine_text();
    report.build = BLUSH_VERSION;
    if (const Result<void> provided = provide_reference(c, *plan, report, guard.interrupted()); !provided) return failed(provided.error());
    {
        Progress progress(c.common.quiet);
        report.result = run_converge(plan->input, report.reference.measured, guard.interrupted(),
                                     [&](double fraction, std::string_view what) { progress.update(fraction, what); });
    }
    if (std::ranges::all_of(report.result.variants, [](const VariantResult& v) { return v.points.empty(); }))
        return failed({.file = c.scene, .what = "interrupted before anything was measured"});
    const OrderedJson json = converge_json(report);
    if (const Result<void> written = write_report(c, report, json); !written) return failed(written.error());
    if (const Result<void> written = write_json(c.common.json, json); !written) return failed(written.error());
    if (!c.common.quiet && c.common.json != "-") print_summary(c, report);
    return exit_done;
}

} // namespace

void add_converge_command(CLI::App& app, std::function<int()>& run) {
    const auto command = std::make_shared<ConvergeCommand>();
    CLI::App* sub = app.add_subcommand("converge", "Measure error over render time for one or more settings: CSV, JSON, HTML report");
    sub->add_option("scene", command->scene, "glTF file (.gltf, .glb)")->required()->type_name("SCENE");
    sub->add_option("-o,--output", command->folder, "Folder for convergence.csv, convergence.json and report.html")
        ->required()
        ->type_name("DIR");
    sub->add_option("--variant", command->variants, "Settings to compare: a name, a colon and options of render; repeatable")
        ->type_name("'NAME: OPTIONS'")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    sub->add_option("--preset", command->preset,
                    "Settings to compare: roulette, strategies, bounces, samplers, caustics or tricks (integrators)")
        ->type_name("NAME");
    sub->add_option("--repeats", command->repeats, "Independent repeats, each with its own seed [4]")
        ->check(CLI::Range(1, 1000))
        ->type_name("N");
    sub->add_option("--reference", command->reference, "Reference EXR [rendered and cached]")->type_name("FILE");
    add_render_options(*sub, command->options);
    add_integrator_option(*sub, command->options);
    add_common_options(*sub, command->common);
    sub->callback([command, &run] { run = [command] { return run_converge_command(*command); }; });
}

} // namespace blush
