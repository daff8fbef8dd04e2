// Integrators for comparison in the place of path tracing.
#include "render/integrator/kernel_settings.h"
#include "render/renderer_state.h"

#include <algorithm>
#include <span>
#include <vector>

namespace blush {

RenderSettings Renderer::State::kernel_settings_for(const RenderSettings& asked) const {
    RenderSettings settings = effective_settings(asked);
    if (!replacement) return settings;
    const int traced = replacement->traced_bounces();
    settings.max_bounces = asked.max_bounces == unlimited_bounces ? traced : std::min(asked.max_bounces, traced);
    settings.reuse = 1;
    settings.caustics = CausticStrategy::off;
    settings.smooth_edges = false;
    settings.clamp = {};
    settings.mis_compensation = false;                            // photons and probes need all of the environment's light
    if (replacement->splats()) settings.strategy = Strategy::mis; // these combine all strategies
    return settings;
}

KernelContext Renderer::State::replacement_context() const {
    KernelContext context = context_for(scene.tables(), film.width(), film.height());
    RenderSettings whole = settings;
    whole.max_bounces = max_bounces;
    const bool filter_textures = context.settings.filter_textures;
    context.settings = kernel_settings(whole, film.width(), film.height());
    context.settings.filter_textures = filter_textures;
    context.settings.reuse = {};
    context.seed = settings.seed;
    return context;
}

bool Renderer::State::prepare_replacement(const Wanted& wanted) {
    if (!replacement || (replacement_is_ready && replacement_origin == scene.origin())) return true;
    replacement_origin = scene.origin();
    replacement_is_ready = replacement->prepare({replacement_context(), workers, replays, wanted, scene.bounding_sphere()});
    return replacement_is_ready;
}

bool Renderer::State::prepare_replacement_for(int64_t sample, const Wanted& wanted) {
    if (!replacement || !replacement->prepares_samples()) return true;
    return replacement->prepare_sample(sample, {replacement_context(), workers, replays, wanted, scene.bounding_sphere()});
}

bool Renderer::State::add_replacement_passes(int64_t first, int64_t count, const Wanted& wanted) {
    if (!replacement || !replacement->splats() || max_bounces == 0) return true;
    std::vector<std::vector<Splat>> tiles;
    for (int64_t pass = first; pass < first + count; ++pass) {
        if (!replacement->trace_pass(pass, {replacement_context(), workers, replays, wanted, scene.bounding_sphere()}, tiles)) return false;
        const std::vector<std::span<const Splat>> lists(tiles.begin(), tiles.end());
        film.add_pass(pass, lists, workers, settings.seed);
    }
    return true;
}

void Renderer::State::add_replacement(const TileJob& job, TileScratch& tile, unsigned worker) {
    if (max_bounces != unlimited_bounces && max_bounces <= replacement->traced_bounces()) return;
    if (!replays[worker]) replays[worker] = std::make_unique<TileScratch>();
    replacement->add(replacement_context(), job, tile, *replays[worker]);
}

} // namespace blush
