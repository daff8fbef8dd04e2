// Biased integrators in the place of path tracing.
#include "render/integrator/kernel_settings.h"
#include "render/renderer_state.h"

namespace blush {

RenderSettings Renderer::State::kernel_settings_for(const RenderSettings& asked) const {
    RenderSettings settings = effective_settings(asked);
    if (!indirect) return settings;
    settings.max_bounces = asked.max_bounces == 0 ? 0 : 1;
    settings.reuse = 1;
    settings.caustics = CausticStrategy::off;
    settings.smooth_edges = false;
    settings.clamp = {};
    return settings;
}

KernelContext Renderer::State::indirect_context() const {
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

bool Renderer::State::prepare_indirect(const Wanted& wanted) {
    if (!indirect || indirect_is_ready) return true;
    const CasterSphere bounds = scene.bounding_sphere();
    indirect_is_ready = indirect->prepare({indirect_context(), workers, replays, wanted, bounds});
    return indirect_is_ready;
}

void Renderer::State::add_indirect(const TileJob& job, TileScratch& tile, unsigned worker) {
    if (max_bounces == 0 || max_bounces == 1) return;
    if (!replays[worker]) replays[worker] = std::make_unique<TileScratch>();
    add_indirect_light(indirect_context(), *indirect, job, tile, *replays[worker]);
}

} // namespace blush
