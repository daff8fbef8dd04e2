#include "app/commands/converge/variants.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <span>

namespace blush {
namespace {

constexpr const char* roulette[]{"off: --roulette off",
                                 "max: --roulette max,start=3",
                                 "luminance: --roulette luminance,start=3",
                                 "sqrt: --roulette sqrt,start=3",
                                 "constant 0.8: --roulette constant=0.8,start=3",
                                 "adjoint: --roulette adjoint,start=1",
                                 "efficiency: --roulette efficiency,start=1",
                                 "splitting: --roulette splitting,start=1",
                                 "biased cut (wrong on purpose): --roulette biased-cut=0.1,start=3"};
constexpr const char* strategies[]{"both, weighted (mis): --strategy mis", "light sampling: --strategy light",
                                   "BSDF sampling: --strategy bsdf"};
constexpr const char* bounces[]{"emission only: --max-bounces 0", "1 bounce: --max-bounces 1",  "2 bounces: --max-bounces 2",
                                "4 bounces: --max-bounces 4",     "8 bounces: --max-bounces 8", "unlimited: --max-bounces unlimited"};

constexpr const char* samplers[]{"random numbers: --sampler random", "Sobol points: --sampler sobol",
                                 "random numbers, adaptive: --sampler random --adaptive on",
                                 "Sobol points, adaptive: --sampler sobol --adaptive on"};

constexpr const char* caustics[]{"without: --caustics off",
                                 "path guiding: --caustics guiding",
                                 "light paths: --caustics light-paths",
                                 "manifold sampling: --caustics manifold",
                                 "all (auto): --caustics auto",
                                 "progressive photon mapping: --integrator progressive-photon-map",
                                 "bidirectional path tracing: --integrator bidirectional",
                                 "Metropolis light transport: --integrator metropolis"};

constexpr const char* tricks[]{"path tracing: --integrator path",
                               "ambient light and occlusion: --integrator ambient",
                               "irradiance cache: --integrator irradiance-cache",
                               "light probes: --integrator light-probes",
                               "photon map: --integrator photon-map",
                               "photon map, final gather: --integrator photon-map,photons=200000,gather=4",
                               "progressive photon mapping: --integrator progressive-photon-map"};

struct Preset {
    const char* name;
    std::span<const char* const> variants;
};
constexpr Preset presets[]{{"roulette", roulette}, {"strategies", strategies}, {"bounces", bounces},
                           {"samplers", samplers}, {"caustics", caustics},     {"tricks", tricks}};

std::string trimmed(const std::string& text) {
    const size_t first = text.find_first_not_of(" \t");
    return first == text.npos ? std::string() : text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

// Options that all variants must share: they have one reference and the same budget. Returns the first that differs.
const char* shared_option(const RenderSettings& a, const RenderSettings& b, const RenderOptions& parsed, const RenderOptions& base) {
    if (a.width != b.width || a.height != b.height) return "--size";
    if (a.spp != b.spp || a.first_sample != b.first_sample || a.seconds != b.seconds || a.error != b.error)
        return "--spp, --time, --error or --samples";
    if (a.seed != b.seed) return "--seed";
    if (parsed.denoise != base.denoise) return "--denoise";
    const SceneOverrides &o = parsed.overrides, &p = base.overrides;
    if (o.camera != p.camera || o.environment != p.environment || o.aperture != p.aperture || o.focus != p.focus ||
        o.texture_mib != p.texture_mib)
        return "--camera, --env, --aperture, --focus or --texture-memory";
    if (o.scene_selection != p.scene_selection) return "--animation, --animation-time, --scene or --material-variant";
    return nullptr;
}

} // namespace

Result<Variant> parse_variant(const std::string& text, const RenderOptions& base) {
    const size_t colon = text.find(':');
    Variant variant;
    variant.name = trimmed(text.substr(0, colon));
    if (colon == text.npos || variant.name.empty())
        return Error{.what = fmt::format("a variant must be 'NAME: OPTIONS', not \"{}\"", text)};
    variant.options = trimmed(text.substr(colon + 1));
    RenderOptions options = base;
    CLI::App app;
    app.set_help_flag();
    add_render_options(app, options);
    add_integrator_option(app, options);
    try {
        app.parse(variant.options);
    } catch (const CLI::ParseError& error) { return Error{.what = fmt::format("variant \"{}\": {}", variant.name, error.what())}; }
    if (const char* shared = shared_option(options.settings, base.settings, options, base))
        return Error{.what = fmt::format("variant \"{}\" must not set {}: all variants share one reference", variant.name, shared)};
    const Result<RenderSettings> settings = settings_of(options);
    if (!settings) return Error{.what = fmt::format("variant \"{}\": {}", variant.name, settings.error().text())};
    variant.settings = *settings;
    variant.integrator = options.integrator;
    return variant;
}

Result<std::vector<Variant>> preset_variants(const std::string& name, const RenderOptions& base) {
    // The presets compare settings of the path tracer without path reuse and adaptive sampling.
    RenderOptions plain = base;
    if (!base.adaptive_given) plain.settings.adaptive = RenderSettings{}.adaptive;
    if (!base.reuse_given) plain.settings.reuse = RenderSettings{}.reuse;
    std::string known;
    for (const Preset& preset : presets) {
        known += fmt::format("{}{}", known.empty() ? "" : ", ", preset.name);
        if (name != preset.name) continue;
        std::vector<Variant> variants;
        for (const char* text : preset.variants) {
            Result<Variant> variant = parse_variant(text, plain);
            if (!variant) return variant.error();
            variants.push_back(*std::move(variant));
        }
        return variants;
    }
    return Error{.what = fmt::format("unknown preset \"{}\" (known: {})", name, known)};
}

} // namespace blush
