#include "app/commands/render/render.h"

#include "app/commands/common.h"
#include "app/commands/denoising.h"
#include "app/commands/error_text.h"
#include "app/commands/interrupt.h"
#include "app/commands/json_output.h"
#include "app/commands/load_scene.h"
#include "app/commands/progress.h"
#include "app/commands/render/allocation_file.h"
#include "app/commands/render/command_feature_report.h"
#include "app/commands/render/film_json.h"
#include "app/commands/render/frame_json.h"
#include "app/commands/render/image_metadata.h"
#include "app/commands/render/peak_memory.h"
#include "app/commands/render/render_loop.h"
#include "app/commands/render/render_options.h"
#include "app/commands/render/resume_image.h"
#include "app/commands/render/write_image.h"
#include "app/common/assets_dir.h"
#include "core/text.h"
#include "io/project/scene_hash.h"
#include "render/film/coverage.h"
#include "render/session/denoised_image.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace blush {
namespace {

struct RenderCommand {
    std::string scene, output, layers, pixel, begun;
    RenderOptions options;
    CommonOptions common;
};

struct PixelRequest {
    int x = 0, y = 0;
    int64_t sample = 0;
};

Result<PixelRequest> parse_pixel(std::string_view text, const RenderSettings& settings) {
    PixelRequest pixel;
    const std::vector<std::string_view> parts = split(text, ',');
    const bool numbers = (parts.size() == 2 || parts.size() == 3) && parse_number(parts[0], pixel.x) && parse_number(parts[1], pixel.y) &&
                         (parts.size() == 2 || (parse_number(parts[2], pixel.sample) && pixel.sample >= 0));
    if (!numbers) return Error{.what = fmt::format("--pixel must be X,Y or X,Y,SAMPLE, not \"{}\"", text)};
    if (pixel.x < 0 || pixel.x >= settings.width || pixel.y < 0 || pixel.y >= settings.height)
        return Error{.what = fmt::format("--pixel {},{} is outside of {}x{}", pixel.x, pixel.y, settings.width, settings.height)};
    return pixel;
}

// Result of checking the command line, before any work is done.
struct Plan {
    RenderSettings settings;
    Layers layers;
    std::optional<PixelRequest> pixel;
    ImageFormat format = ImageFormat::exr;
    std::optional<ResumeImage> begun; // --continue
};

// Result of a render.
struct Rendered {
    LoopResult loop;
    CompiledInfo info;
    std::optional<Denoised> denoised;
    std::vector<Diagnostic> warnings; // from the import, the compilation and the render
    std::vector<Vec3> error;          // if the layer error is requested
    std::optional<FilmState> film;    // if the layer film is requested
};

Result<Plan> plan_of(const RenderCommand& c) {
    Plan plan;
    const Result<RenderSettings> settings = settings_of(c.options);
    if (!settings) return settings.error();
    plan.settings = *settings;
    if (!c.begun.empty() && !same_image(*settings, recommended_settings()))
        return Error{.what = "--continue takes all settings from the image; only --spp, --time and --error may be given"};
    if (!c.layers.empty()) {
        const Result<Layers> layers = parse_layers(c.layers);
        if (!layers) return layers.error();
        plan.layers = *layers;
    }
    const bool comparison = c.options.integrator.kind != ComparisonIntegrator::Kind::none;
    const Layers& l = plan.layers;
    if (comparison &&
        (l.film || l.groups || l.bounces > 0 || l.strategies || !c.begun.empty() || c.options.samples_given || !c.pixel.empty()))
        return Error{.what = "--integrator excludes --continue, --samples, --pixel and the layers film, groups, bounces and strategies"};
    if (comparison && plan.settings.clamp.limit > 0) return Error{.what = "--integrator and --clamp exclude each other"};
    if (!c.pixel.empty()) {
        const Result<PixelRequest> pixel = parse_pixel(c.pixel, plan.settings);
        if (!pixel) return pixel.error();
        plan.pixel = *pixel;
        return plan;
    }
    if (c.output.empty()) return Error{.what = "render needs -o OUT.exr, OUT.png or OUT.jpg"};
    const Result<ImageFormat> format = image_format(c.output);
    if (!format) return format.error();
    plan.format = *format;
    if (const std::string extension = lower_extension(c.output); extension == ".jpg" || extension == ".jpeg")
        if (const Result<void> fits = expect_jpeg_size(c.output, plan.settings.width, plan.settings.height); !fits) return fits.error();
    if (plan.layers.any() && plan.format != ImageFormat::exr) return Error{.what = "--layers needs an .exr output"};
    return plan;
}

bool is_warning(const Diagnostic& d) { return d.severity == Diagnostic::Severity::warning; }

// True if no camera ray hits a surface. Bounce or shadow rays prove hits; otherwise, for example for purely emissive surfaces, a
// small depth image decides.
bool sees_nothing(const Scene& scene, const RenderSettings& settings, const RayCounts& rays, unsigned threads) {
    if (rays.bounce > 0 || rays.shadow > 0) return false;
    RenderSettings small;
    small.width = std::min(settings.width, 128);
    small.height = std::max(1, int(int64_t(small.width) * settings.height / settings.width));
    small.height = std::min(small.height, 512);
    small.region = settings.region;
    Renderer renderer({.threads = threads, .planes = {.depth = true}});
    renderer.update(scene, small);
    renderer.render(0, 4);
    const Frame frame = renderer.resolve();
    return std::ranges::none_of(frame.depth, [](float depth) { return depth > 0; });
}

std::string loop_note(const LoopProgress& p) {
    std::string note = fmt::format("{} spp", p.samples);
    if (p.error.known) note += fmt::format(", error {:.2g}", p.error.relmse);
    return note;
}

// "bidirectional"; empty for path tracing.
std::string integrator_text(const ComparisonIntegrator& integrator) {
    return integrator.kind == ComparisonIntegrator::Kind::none ? std::string() : to_string(integrator);
}

// "irradiance-cache,a=0.2,rays=256: biased, ..."; empty for unbiased integrators.
std::string biased_text(const ComparisonIntegrator& integrator) {
    if (bias_of(integrator.kind).empty()) return {};
    return fmt::format("{}: {}, {}", to_string(integrator), verdict_of(integrator.kind), bias_of(integrator.kind));
}

SnapshotMetadata metadata_of(const RenderCommand& c, const Plan& plan, const LoadedScene& loaded, const Rendered& rendered) {
    SnapshotMetadata m = image_metadata(c.scene, scene_hash(loaded.imported), loaded, plan.settings, rendered.loop);
    m.integrator = integrator_text(c.options.integrator);
    m.biased = biased_text(c.options.integrator);
    if (rendered.denoised) m.denoised = denoised_by(*rendered.denoised);
    if (rendered.film) m.film = film_json(*rendered.film);
    return m;
}

OrderedJson result_json(const RenderCommand& c, const RenderSettings& settings, const Rendered& rendered) {
    const LoopResult& r = rendered.loop;
    const RayCounts& rays = r.frame.rays;
    const double paths = double(rays.camera), seconds = std::max(r.seconds, 1e-9);
    const ErrorEstimate& error = r.frame.error;
    const auto if_known = [](bool known, const auto& value) { return known ? OrderedJson(value) : OrderedJson(); };
    OrderedJson json;
    json["scene"] = c.scene;
    json["width"] = r.frame.width;
    json["height"] = r.frame.height;
    json["spp"] = r.samples;
    json["seconds"] = r.seconds;
    json["seconds_setup"] = rendered.info.seconds_setup;
    json["rays"] = {{"camera", rays.camera}, {"bounce", rays.bounce}, {"shadow", rays.shadow}};
    for (size_t k = 0; k < stage_names.size(); ++k) json["stages"][std::string(stage_names[k])] = r.frame.stages.of[k];
    json["mrays_per_s"] = double(rays.total()) / seconds * 1e-6;
    json["mpaths_per_s"] = paths / seconds * 1e-6;
    json["path_length_mean"] = paths > 0 ? double(rays.camera + rays.bounce) / paths : 0.0;
    json["error"] = {{"relmse", if_known(error.known, error.relmse)},
                     {"low", if_known(error.known, error.low)},
                     {"high", if_known(error.known, error.high)},
                     {"rmse", if_known(error.rmse_known, error.rmse)},
                     {"rmse_low", if_known(error.rmse_known, error.rmse_low)},
                     {"rmse_high", if_known(error.rmse_known, error.rmse_high)},
                     {"misses_highlights", error.misses_highlights},
                     {"missing_light", if_known(!r.frame.missing_light.empty(), r.frame.missing_light)}};
    if (const std::string biased = biased_text(c.options.integrator); !biased.empty()) json["biased"] = biased;
    if (const std::string integrator = integrator_text(c.options.integrator); !integrator.empty()) json["integrator"] = integrator;
    json["health"] = health_json(r.frame.health);
    json["warnings"] = OrderedJson::array();
    for (const Diagnostic& d : rendered.warnings) json["warnings"].push_back(Error{{}, d.what, d.where}.text());
    if (!r.frame.bounces.empty()) json["bounces"] = bounces_json(r.frame);
    if (!r.frame.strategies.empty()) json["strategies"] = strategies_json(r.frame);
    if (!r.frame.groups.empty()) json["groups"] = groups_json(r.frame);
    if (settings.clamp.limit > 0) json["clamp"] = clamp_json(settings.clamp, r.frame.clamp);
    CommandFeatures beside;
    beside.display = is_display_encoded(c.output);
    if (rendered.denoised) beside.denoiser = c.options.denoise;
    json["kernel"] = kernel_json(rendered.info.kernel, with_command_features(rendered.info.features, beside));
    if (rendered.denoised) json["denoise"] = denoised_json(*rendered.denoised);
    json["peak_memory_mb"] = peak_memory_mb();
    json["output"] = c.output;
    json["partial"] = !r.complete;
    return json;
}

void print_summary(const RenderCommand& c, const Rendered& rendered) {
    const LoopResult& r = rendered.loop;
    fmt::print("{}: {}x{}, {} spp in {:.2f} s, {:.2f} Mpaths/s", c.output, r.frame.width, r.frame.height, r.samples, r.seconds,
               double(r.frame.rays.camera) / std::max(r.seconds, 1e-9) * 1e-6);
    fmt::print(", {}", error_text(r.frame.error, 2));
    if (!r.frame.missing_light.empty()) fmt::print(", some light cannot be found");
    if (rendered.denoised) fmt::print(", {}", denoised_summary(*rendered.denoised));
    fmt::print("{}\n", r.complete ? "" : ", partial");
    if (const std::string biased = biased_text(c.options.integrator); !biased.empty())
        fmt::print("{}; the error is that of noise alone\n", biased);
    else if (const std::string integrator = integrator_text(c.options.integrator); !integrator.empty())
        fmt::print("{}: {}\n", integrator, verdict_of(c.options.integrator.kind));
    if (r.frame.clamp.samples > 0)
        fmt::print("clamping removed {:.3g} % of the light, from {} samples\n", 100 * r.frame.clamp.share, r.frame.clamp.samples);
    if (r.frame.health.dropped() > 0)
        fmt::print("{} samples dropped, the first: {}\n", r.frame.health.dropped(), describe(r.frame.health.first.front()));
}

PlaneSet planes_for(const RenderCommand& c, const Plan& plan) {
    PlaneSet planes = planes_of(plan.layers);
    if (c.options.denoise) planes.albedo = planes.normal = planes.half_difference = true;
    if (c.options.view.false_color.of == FalseColor::Of::lux) planes.albedo = true;
    if (c.options.view.background_as_it_is) planes.ids = true;
    return planes;
}

Result<void> write_image(const RenderCommand& c, const Plan& plan, const Rendered& rendered, const SnapshotMetadata& metadata,
                         const ColorManagement* color) {
    const Frame& frame = rendered.loop.frame;
    ExtraLayers extra{.error = rendered.error};
    if (rendered.denoised) extra.denoised = rendered.denoised->rgb;
    const std::vector<LosslessPlane> film = rendered.film ? planes_in_file(*rendered.film) : std::vector<LosslessPlane>();
    extra.film = film;
    if (!color) {
        const Result<int64_t> written = write_exr_image(c.output, frame, extra, plan.layers, metadata);
        return written ? Result<void>() : written.error();
    }
    std::vector<float> rgb = rendered.denoised ? rendered.denoised->rgb : beauty_rgb(frame);
    const std::vector<float> coverage = coverage_of(frame);
    return write_through_view(c.output, frame.width, frame.height, std::move(rgb), *color, c.options.view, display_metadata(metadata),
                              {frame.albedo, coverage}, opacity_of(frame));
}

// Errors: unreadable, of another scene or size.
Result<SampleAllocation::Shares> allocation_for(const std::string& file, const LoadedScene& loaded, const RenderSettings& settings) {
    Result<AllocationFile> allocation = read_allocation(file);
    if (!allocation) return allocation.error();
    if (allocation->scene_hash != scene_hash(loaded.imported)) return Error{file, "was made for another scene", "scene_hash"};
    if (allocation->width != settings.width || allocation->height != settings.height)
        return Error{file, fmt::format("was made for an image of {}x{}", allocation->width, allocation->height), ""};
    return std::move(allocation->shares);
}

// Renders, denoises if requested, and writes the output. The raw render is written even if denoising fails.
Result<Rendered> render_image(const RenderCommand& c, const Plan& plan, const LoadedScene& loaded, const ColorManagement* color,
                              Denoiser& denoiser, const std::atomic<bool>& interrupted) {
    RendererOptions options{.threads = c.common.threads, .planes = planes_for(c, plan)};
    options.integrator = c.options.integrator;
    options.is_part = c.options.samples_given || (plan.begun && plan.begun->film.first_sample > 0);
    if (!c.options.allocation.empty()) {
        Result<SampleAllocation::Shares> shares = allocation_for(c.options.allocation, loaded, plan.settings);
        if (!shares) return shares.error();
        options.allocation = *std::move(shares);
    }
    Renderer renderer(options);
    renderer.update(loaded.scene, plan.settings);
    LoopProgress begin;
    if (plan.begun) {
        const FilmState& film = plan.begun->film;
        if (const Result<void> continued = renderer.load_film(film); !continued) return in_file(continued.error(), c.begun);
        begin.samples = film.samples;
        begin.seconds = film.seconds;
    }
    Rendered rendered;
    rendered.info = renderer.info();
    if (!c.common.quiet) print_warnings(c.scene, rendered.info.warnings);
    std::ranges::copy_if(loaded.report.diagnostics, std::back_inserter(rendered.warnings), is_warning);
    std::ranges::copy_if(rendered.info.warnings, std::back_inserter(rendered.warnings), is_warning);
    {
        Progress progress(c.common.quiet);
        rendered.loop = run_render_loop(
            renderer, plan.settings, interrupted, [&](const LoopProgress& p) { progress.update(p.fraction, loop_note(p)); }, begin);
    }
    rendered.info.features = renderer.info().features; // pilots have decided
    if (rendered.loop.samples == 0) return Error{.file = c.scene, .what = "interrupted before the first sample"};
    if (sees_nothing(loaded.scene, plan.settings, rendered.loop.frame.rays, c.common.threads)) {
        const Diagnostic nothing{Diagnostic::Severity::warning,
                                 "the camera sees no object of the scene: the image shows only the background", ""};
        if (!c.common.quiet) print_warnings(c.scene, {nothing});
        rendered.warnings.push_back(nothing);
    }
    Result<void> denoised;
    if (c.options.denoise) {
        // The Ctrl-C that stopped the samples does not stop the denoiser; a new one does.
        const std::atomic<bool> never{false};
        const Frame& frame = rendered.loop.frame;
        Result<std::vector<Denoised>> result =
            denoise_with_progress(denoiser, denoise_inputs(frame), *c.options.denoise, c.common.quiet, interrupted ? never : interrupted);
        if (result)
            rendered.denoised = denoised_image(frame, *c.options.denoise, *std::move(result))->denoised;
        else
            denoised = result.error();
    }
    if (plan.layers.error) rendered.error = renderer.resolve_error();
    if (plan.layers.film) {
        Result<FilmState> film = renderer.save_film(plan.settings.first_sample);
        if (!film) return in_file(film.error(), c.output);
        film->seconds = rendered.loop.seconds;
        rendered.film = *std::move(film);
    }
    const Result<void> written = write_image(c, plan, rendered, metadata_of(c, plan, loaded, rendered), color);
    if (!written) return in_file(written.error(), c.output);
    if (!denoised) return Error{c.output, "written without denoising because of an error: " + denoised.error().text(), ""};
    return rendered;
}

// Settings come from the image, stop rules from the command line.
Result<void> resume_from(const std::string& file, Plan& plan) {
    Result<ResumeImage> begun = read_resume_image(file);
    if (!begun) return begun.error();
    const RenderSettings stop = std::exchange(plan.settings, begun->metadata.settings);
    plan.settings.spp = stop.spp;
    plan.settings.seconds = stop.seconds;
    plan.settings.error = stop.error;
    plan.begun = *std::move(begun);
    return {};
}

// A missing side of the size follows the camera's aspect ratio; prints a note if an explicit size has another aspect ratio.
Result<void> fit_size(RenderCommand& c, Plan& plan, float camera_aspect) {
    if (!(camera_aspect > 0) || plan.begun) return {};
    const RenderSettings& s = plan.settings;
    if (c.options.width_given && c.options.height_given) {
        const float aspect = float(s.width) / float(s.height);
        if (!c.common.quiet && std::abs(aspect / camera_aspect - 1) > 0.02f)
            fmt::print(stderr,
                       "blush: note: {}x{} is {:.3g}:1, the camera's frame is {:.3g}:1; the vertical field of view is the camera's\n",
                       s.width, s.height, aspect, camera_aspect);
        return {};
    }
    follow_aspect(c.options, camera_aspect);
    Result<Plan> fitted = plan_of(c);
    if (!fitted) return fitted.error();
    plan = *std::move(fitted);
    return {};
}

int run_render(RenderCommand c) {
    Result<Plan> plan = plan_of(c);
    if (!plan) return bad_usage(plan.error().text());
    if (!c.begun.empty())
        if (const Result<void> begun = resume_from(c.begun, *plan); !begun) return failed(begun.error());
    if (!plan->pixel)
        if (const Result<void> folder = expect_folder(c.output); !folder) return failed(folder.error());
    // Before other threads allocate memory, which the libraries may then lack.
    if (!plan->pixel)
        if (const Result<void> encoder = load_encoder(c.output); !encoder) return failed(encoder.error());
    const Result<std::optional<ColorManagement>> color = color_for(plan->pixel ? ImageFormat::exr : plan->format, c.options.view);
    if (!color) return failed(color.error());
    Denoiser denoiser(weights_dir(), c.common.threads);
    if (c.options.denoise && !plan->pixel)
        if (const Result<void> able = try_denoiser(denoiser, *c.options.denoise); !able) return failed(able.error());
    if (*color && !c.common.quiet && !(*color)->warning().empty()) fmt::print(stderr, "blush: warning: {}\n", (*color)->warning());

    const InterruptGuard guard;
    const float aspect = float(plan->settings.width) / float(plan->settings.height);
    Result<LoadedScene> loaded = [&] {
        Progress progress(c.common.quiet);
        return load_scene(c.scene, c.options.overrides, aspect, progress, guard.interrupted());
    }();
    if (loaded && plan->begun) loaded = scene_at_save(*std::move(loaded), c.scene, *plan->begun, c.begun);
    if (!loaded) return failed(loaded.error());
    if (const Result<void> fits = fit_size(c, *plan, loaded->camera_aspect); !fits) return bad_usage(fits.error().text());
    if (!c.common.quiet) print_warnings(c.scene, loaded->report.diagnostics);
    if (plan->layers.groups && loaded->scene.mix.grouping == LightMix::Grouping::none)
        loaded->scene.mix.grouping = LightMix::Grouping::by_light;

    if (plan->pixel) {
        fmt::print("{}", trace_sample(loaded->scene, plan->settings, plan->pixel->x, plan->pixel->y, plan->pixel->sample));
        return exit_done;
    }
    const Result<Rendered> rendered = render_image(c, *plan, *loaded, *color ? &**color : nullptr, denoiser, guard.interrupted());
    if (!rendered) return failed(rendered.error());
    if (const Result<void> written = write_json(c.common.json, result_json(c, plan->settings, *rendered)); !written)
        return failed(written.error());
    if (!c.common.quiet && c.common.json != "-") print_summary(c, *rendered);
    return exit_done;
}

} // namespace

void add_render_command(CLI::App& app, std::function<int()>& run) {
    const auto command = std::make_shared<RenderCommand>();
    CLI::App* sub = app.add_subcommand("render", "Render a scene to an .exr, .png or .jpg file");
    sub->add_option("scene", command->scene, "glTF file (.gltf, .glb)")->required()->type_name("SCENE");
    sub->add_option("-o,--output", command->output, "EXR keeps scene-linear values; PNG and JPEG go through the view transform")
        ->type_name("FILE");
    add_render_options(*sub, command->options);
    add_integrator_option(*sub, command->options);
    sub->add_option("--layers", command->layers,
                    "Additional layers, EXR only: albedo,normal,depth,error,samples,id,groups,bounces[=N],strategies,film (sums, for "
                    "--continue and merge)")
        ->type_name("LIST");
    sub->add_option("--continue", command->begun, "Resume a render that was saved with the layer film, up to --spp, --time or --error")
        ->type_name("EXR");
    sub->add_option("--allocation", command->options.allocation,
                    "With --samples and --adaptive on: allocation of adaptive sampling that merge --allocation has written")
        ->type_name("JSON");
    sub->add_option("--pixel", command->pixel, "Trace a single sample and print every vertex, instead of rendering")
        ->type_name("X,Y[,SAMPLE]");
    add_common_options(*sub, command->common);
    sub->callback([command, &run] { run = [command] { return run_render(*command); }; });
}

} // namespace blush
