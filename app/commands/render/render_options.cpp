#include "app/commands/render/render_options.h"

#include "app/commands/denoising.h"
#include "core/text.h"
#include "render/film/sample_allocation.h"
#include "scene/validate.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace blush {
namespace {

// Adds an option whose text is parsed by `parse` and stored in `target`.
template <class T> CLI::Option* add_parsed(CLI::App& app, const std::string& name, T& target, Result<T> (*parse)(std::string_view),
                                           const std::string& description, bool* given = nullptr) {
    return app.add_option_function<std::string>(
        name,
        [name, &target, parse, given](const std::string& text) {
            Result<T> value = parse(text);
            if (!value) throw CLI::ValidationError(name, value.error().text());
            target = *std::move(value);
            if (given) *given = true;
        },
        description);
}

constexpr float default_aspect = 16.f / 9; // aspect ratio of the size without --size

// 0: side not given
struct Size {
    int width = 0, height = 0;
};

Result<Size> parse_size(std::string_view text) {
    Size size;
    const std::vector<std::string_view> sides = split(text, 'x');
    bool zero = false; // 0 was given explicitly, which is invalid
    const auto side = [&](std::string_view digits, int& pixels) {
        if (digits.empty()) return true;
        const bool read = parse_number(digits, pixels);
        zero |= read && pixels == 0;
        return read;
    };
    const bool known = sides.size() == 2 && side(sides[0], size.width) && side(sides[1], size.height);
    if (known && zero) return Error{.what = fmt::format("width and height must be from 1 to 65536, not \"{}\"", text)};
    if (known && (size.width != 0 || size.height != 0)) return size;
    return Error{.what = fmt::format("a size must be WIDTHxHEIGHT, WIDTHx or xHEIGHT, not \"{}\"", text)};
}

struct SampleRange {
    int64_t first = 0, last = 0;
};

Result<SampleRange> parse_samples(std::string_view text) {
    SampleRange range;
    const std::vector<std::string_view> ends = split(text, ':');
    if (ends.size() == 2 && parse_number(ends[0], range.first) && parse_number(ends[1], range.last) && range.first >= 0 &&
        range.first < range.last)
        return range;
    return Error{.what = fmt::format("samples must be A:B with 0 <= A < B, not \"{}\"", text)};
}

Result<std::optional<PixelRect>> parse_region(std::string_view text) {
    const std::vector<std::string_view> parts = split(text, ',');
    int x = 0, y = 0, width = 0, height = 0;
    const bool numbers = parts.size() == 4 && parse_number(parts[0], x) && parse_number(parts[1], y) && parse_number(parts[2], width) &&
                         parse_number(parts[3], height);
    constexpr int max_side = 65536; // maximum width and height in pixels
    if (numbers && x >= 0 && y >= 0 && width > 0 && height > 0 && std::max({x, y, width, height}) <= max_side)
        return std::optional(PixelRect{x, y, x + width, y + height});
    return Error{.what = fmt::format("a region must be X,Y,WIDTH,HEIGHT in pixels, not \"{}\"", text)};
}

Result<bool> parse_switch(std::string_view text) {
    if (text == "on") return true;
    if (text == "off") return false;
    return Error{.what = fmt::format("must be on or off, not \"{}\"", text)};
}

Result<std::optional<DenoiseQuality>> parse_denoise(std::string_view text) {
    if (text == "off") return std::optional<DenoiseQuality>();
    const Result<DenoiseQuality> quality = parse_denoise_quality(text);
    if (!quality) return Error{.what = fmt::format("must be off, fast or high, not \"{}\"", text)};
    return std::optional(*quality);
}

void add_size_option(CLI::App& app, RenderOptions& o) {
    app.add_option_function<std::string>(
           "--size",
           [&o](const std::string& text) {
               const Result<Size> size = parse_size(text);
               if (!size) throw CLI::ValidationError("--size", size.error().text());
               o.width_given = size->width != 0;
               o.height_given = size->height != 0;
               o.size_given = true;
               if (o.width_given) o.settings.width = size->width;
               if (o.height_given) o.settings.height = size->height;
               if (!o.width_given || !o.height_given) follow_aspect(o, default_aspect);
           },
           "Size in pixels; for Wx or xH the other side follows the camera's aspect ratio [1280 wide]")
        ->type_name("WxH");
}

void add_region_option(CLI::App& app, RenderOptions& o) {
    add_parsed(app, "--region", o.region, parse_region, "Render only these pixels; the rest of the image stays empty [all]")
        ->type_name("X,Y,W,H");
}

void add_scene_options(CLI::App& app, RenderOptions& o) {
    app.add_option("--camera", o.overrides.camera, "Camera [the first; in a scene without cameras, one is framed around the scene]")
        ->type_name("NAME|INDEX");
    app.add_option("--aperture", o.overrides.aperture, "Radius of the thin lens in metres; 0 is a pinhole [the camera's]")->type_name("M");
    app.add_option("--focus", o.overrides.focus, "Focus distance in metres [the camera's]")->type_name("M");
    app.add_option_function<std::string>(
           "--env",
           [&o](const std::string& text) {
               const Result<EnvironmentChoice> choice = parse_environment(text);
               if (!choice) throw CLI::ValidationError("--env", choice.error().text());
               o.overrides.environment = *choice;
           },
           "Environment: a lat-long HDR or EXR file, none, or constant=R,G,B [the scene's]")
        ->type_name("FILE[,intensity=X][,rotate=DEG]");
    app.add_option("--texture-memory", o.overrides.texture_mib,
                   "Memory limit of all decoded textures; the largest are halved until they fit, with a warning [4096]")
        ->check(CLI::Range(int64_t(1), int64_t(1) << 30))
        ->type_name("MIB");
}

void add_light_option(CLI::App& app, RenderOptions& o) {
    add_parsed(
        app, "--light", o.overrides.light, parse_light,
        "Lighting for a scene without lights: three softboxes and a studio panorama, or a sky, both for exposure 0 [none, with a warning]")
        ->type_name("studio|sky|none");
}

void add_groups_option(CLI::App& app, RenderOptions& o) {
    add_parsed(app, "--groups", o.overrides.groups, parse_grouping,
               "Light groups: which lights share a plane of the layer \"groups\" and a gain of the light mix [the scene's; by-light for "
               "that layer]")
        ->type_name("off|by-light|by-object|by-material|by-hand");
}

void add_stop_options(CLI::App& app, RenderOptions& o) {
    app.add_option_function<int64_t>(
           "--spp",
           [&o](const int64_t& spp) {
               o.settings.spp = spp;
               o.spp_given = true;
           },
           "Stop at N samples per pixel [64, or no limit if --time or --error is given]")
        ->check(CLI::Range(int64_t(1), int64_t(1) << 40))
        ->type_name("N");
    app.add_option("--time", o.settings.seconds, "Stop after S seconds of rendering")->type_name("S");
    app.add_option("--error", o.settings.error, "Stop at an estimated relative error (relMSE) of E")->type_name("E");
    app.add_option_function<std::string>(
           "--samples",
           [&o](const std::string& text) {
               const Result<SampleRange> range = parse_samples(text);
               if (!range) throw CLI::ValidationError("--samples", range.error().text());
               o.settings.first_sample = range->first;
               o.settings.spp = range->last;
               o.samples_given = true;
           },
           "Render only the sample indices A to B - 1 [0:spp]")
        ->type_name("A:B");
}

void add_path_options(CLI::App& app, RenderOptions& o) {
    app.add_option("--seed", o.settings.seed, "Random seed: same seed, same image [0]")->type_name("K");
    add_parsed(app, "--max-bounces", o.settings.max_bounces, parse_max_bounces, "Maximum number of scattering events of a path [unlimited]")
        ->type_name("N|unlimited");
}

void add_estimator_options(CLI::App& app, RenderOptions& o) {
    add_parsed(app, "--roulette", o.settings.roulette, parse_roulette,
               "Russian roulette: auto, off, max, luminance, sqrt, constant=P, adjoint, efficiency, splitting, biased-cut=T [auto,start=3]")
        ->type_name("RULE[,start=N][,floor=P][,cap=P]");
    add_parsed(app, "--strategy", o.settings.strategy, parse_strategy, "Direct light by MIS, light sampling (NEE) or BSDF sampling [mis]")
        ->type_name("mis|light|bsdf");
    add_parsed(
        app, "--heuristic", o.settings.heuristic, parse_heuristic,
        "Heuristic of MIS, for comparison: power=N (N from 1 to 8), balance, cutoff=T or maximum; strategies for caustics need power=2 "
        "[power=2]")
        ->type_name("power=N|balance|cutoff=T|maximum");
    add_parsed(app, "--caustics", o.settings.caustics, parse_caustics,
               "Which strategies for caustics pilots may choose, for comparison: all, none, path guiding, light paths or manifold sampling "
               "[auto]")
        ->type_name("auto|off|guiding|light-paths|manifold");
    add_parsed(app, "--mis-compensation", o.settings.mis_compensation, parse_switch,
               "Light sampling leaves the even part of an environment to BSDF sampling (MIS compensation) [on]")
        ->type_name("on|off");
    add_parsed(app, "--energy-compensation", o.settings.energy_compensation, parse_switch,
               "Energy compensation for multiple scattering between microfacets [off]")
        ->type_name("on|off");
    add_parsed(app, "--adaptive", o.settings.adaptive, parse_switch,
               "Adaptive sampling: more samples in noisy pixels, N per pixel on average [on]", &o.adaptive_given)
        ->type_name("on|off");
    add_parsed(
        app, "--reuse", o.settings.reuse, parse_reuse,
        "Path reuse: number of pixels that share light at a second diffuse surface; auto: 8 or 16 where a pilot measures that this pays "
        "[auto]",
        &o.reuse_given)
        ->type_name("auto|off|4|8|16");
    add_parsed(
        app, "--smooth-edges", o.settings.smooth_edges, parse_switch,
        "More samples of the emission at the edges of visible emitters, and of highlights of lamps in mirrors and glass, where a pilot "
        "finds that this pays [on]")
        ->type_name("on|off");
    add_parsed(app, "--clamp", o.settings.clamp, parse_clamp,
               "Clamp samples of indirect light, or of all light, to X nits: biased, the summary prints the removed light [off]")
        ->type_name("off|X[,all]");
    add_parsed(app, "--filter", o.settings.filter, parse_filter, "Pixel filter [blackman-harris]")->type_name("blackman-harris|box");
    add_parsed(app, "--sampler", o.settings.sampler, parse_sampler,
               "Sobol points (stratified), or independent random numbers for comparison [sobol]")
        ->type_name("sobol|random");
}

} // namespace

void add_view_options(CLI::App& app, ViewSettings& view) {
    add_parsed(app, "--auto-exposure", view.auto_exposure, parse_auto_exposure,
               "Auto exposure, only for display output: log-average to middle grey, or highlights to white; --exposure is added [off]")
        ->type_name("off|average|highlights");
    add_parsed(app, "--white", view.white, parse_white,
               "White balance, only for display output: scene-linear colour that becomes neutral [1,1,1]")
        ->type_name("R,G,B");
    add_parsed(app, "--false-color", view.false_color, parse_false_color,
               "False colours, only for display output: stops from middle grey, nits, or lux on diffuse surfaces [off]")
        ->type_name("off|stops|nits|lux[=LOW:HIGH]");
    app.add_flag("--background-as-it-is", view.background_as_it_is,
                 "Do not apply exposure, white balance, look and view to the background, only for display output");
    app.add_option("--exposure", view.exposure_ev, "Exposure in stops, only for display output: never in an EXR [0]")->type_name("EV");
    app.add_option("--view", view.view, "View transform, only for display output [the config's default]")->type_name("NAME");
    app.add_option("--look", view.look, "Look, only for display output [the view's default]")->type_name("NAME");
    app.add_option("--display", view.display, "Display, only for display output [the config's default]")->type_name("NAME");
}

void add_probe_options(CLI::App& app, RenderOptions& options) {
    add_size_option(app, options);
    add_scene_options(app, options);
    add_scene_selection_options(app, options.overrides.scene_selection);
    add_light_option(app, options);
    add_path_options(app, options);
}

void add_integrator_option(CLI::App& app, RenderOptions& o) {
    add_parsed(
        app, "--integrator", o.integrator, parse_integrator,
        "Path tracing or, for comparison, another integrator: direct light with ambient light and occlusion, an irradiance cache, "
        "light probes or a photon map, which are biased, progressive photon mapping, which is consistent, or bidirectional path tracing or "
        "Metropolis light transport, which are unbiased [path]")
        ->type_name(
            "path|ambient[,color=R:G:B|auto][,distance=M]|irradiance-cache[,a=A][,rays=N][,baked]|light-probes[,grid=N][,rays=N][,baked]|"
            "photon-map[,photons=N][,radius=M|auto][,gather=N][,baked]|progressive-photon-map[,photons=N][,radius=M|auto][,alpha=A]|"
            "bidirectional|metropolis[,large=P][,chain=N]");
}

void add_render_options(CLI::App& app, RenderOptions& options) {
    add_size_option(app, options);
    add_region_option(app, options);
    add_scene_options(app, options);
    add_scene_selection_options(app, options.overrides.scene_selection);
    add_light_option(app, options);
    add_groups_option(app, options);
    add_stop_options(app, options);
    add_path_options(app, options);
    add_estimator_options(app, options);
    add_view_options(app, options.view);
    add_parsed(app, "--denoise", options.denoise, parse_denoise,
               "Denoise the result: an additional layer \"denoised\" in an EXR; a PNG or JPEG shows the denoised image [off]")
        ->type_name("off|fast|high");
}

void follow_aspect(RenderOptions& options, float aspect) {
    if (!(aspect > 0) || (options.width_given && options.height_given)) return;
    static constexpr double max_side = 1e6; // rejected by validate()
    const auto pixels = [](double side) { return int(std::lround(std::clamp(side, 1.0, max_side))); };
    RenderSettings& s = options.settings;
    if (options.height_given)
        s.width = pixels(double(s.height) * double(aspect));
    else
        s.height = pixels(double(s.width) / double(aspect));
}

namespace {

// Parts of the pilot of adaptive sampling, from which the allocation is decided, end at its half and at its end.
bool is_pilot_range(int64_t first, int64_t last) {
    constexpr int64_t half = SampleAllocation::pilot_samples / 2;
    return first == 0 || last <= half || (first >= half && last <= 2 * half);
}

} // namespace

Result<RenderSettings> settings_of(const RenderOptions& options) {
    RenderSettings settings = options.settings;
    if (options.spp_given && options.samples_given) return Error{.what = "--spp and --samples exclude each other"};
    if (options.samples_given && !options.adaptive_given) settings.adaptive = false;
    if (settings.adaptive && options.samples_given && options.allocation.empty() && !is_pilot_range(settings.first_sample, settings.spp))
        return Error{.what = "--samples of adaptive sampling needs --allocation, or a part of the pilot: A:B within 0:8 or 8:16"};
    if (!options.allocation.empty() && !(settings.adaptive && options.samples_given))
        return Error{.what = "--allocation needs --samples and --adaptive on"};
    if (const auto& r = options.region) {
        const float w = float(settings.width), h = float(settings.height);
        if (r->x1 > settings.width || r->y1 > settings.height)
            return Error{.what = fmt::format("--region is outside of the image of {}x{}", settings.width, settings.height)};
        settings.region = {float(r->x0) / w, float(r->y0) / h, float(r->x1 - r->x0) / w, float(r->y1 - r->y0) / h};
        if (options.adaptive_given && settings.adaptive)
            return Error{.what = "--adaptive and --region exclude each other: adaptive sampling needs the whole image"};
        settings = effective_settings(settings);
    }
    const bool other_limit = settings.seconds > 0 || settings.error > 0;
    if (other_limit && !options.spp_given && !options.samples_given) settings.spp = 0;
    if (Result<void> valid = validate(settings); !valid) return valid.error();
    if (Result<void> valid = validate(options.view); !valid) return valid.error();
    return settings;
}

} // namespace blush
