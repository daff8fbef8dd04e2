// Traces one sample again, vertex by vertex, using the kernels' own stages with one lane. A sample is a function of scene,
// settings, pixel, index and seed, so this reproduces what the film received (with path reuse, before sharing; without light paths, which
// light_path_replay.h has; without splitting).
#pragma once

#include "render/integrator/wavefront.h"
#include "scene/affine.h"

#include <memory>
#include <utility>

namespace blush {

// A vertex of the path and the result of its step. `arrived`: contribution of NEE, black if occluded. `past`:
// of the background behind blended surfaces, one of which stopped the path. `chains`: of manifold sampling at this vertex, and of emission
// that it shares (`shared`), which is not in `step`. `light_vertices`: of connections to these. `panes`: emission of panes that the ray has
// passed.
struct ReplayedVertex {
    int bounce = 0;
    Path<float> path;
    Hit<float> hit;
    Step<float> step;
    Vec3 arrived, past{0, 0, 0}, shared{0, 0, 0}, chains{0, 0, 0}, light_vertices{0, 0, 0}, panes{0, 0, 0};
};

// Calls visit(vertex) for each vertex while it returns true, at most `longest` times. Returns the radiance so far. Call it from
// within Workers::run or for_each.
template <class Visit>
Vec3 replay_sample(KernelContext context, int x, int y, int64_t sample, int longest, TileScratch& scratch, const Visit& visit) {
    constexpr Features s = all_features.with(Feature::light_paths);
    context.settings.reuse = {};
    const auto radiance = [&] { return Vec3d{scratch.r[0], scratch.g[0], scratch.b[0]}; };
    PathQueue *now = &scratch.paths[0], *next = &scratch.paths[1];
    generate_paths<s, float>(context, {x, y, 1, 1, sample, 1}, scratch);
    if (samples_manifolds<s>(*context.scene)) scratch.manifolds = std::make_unique<ManifoldColumns>();
    if (connects_light_vertices<s>(*context.scene)) trace_light_vertices<s, float>(context, scratch);
    for (int bounce = 0; now->size > 0 && bounce < longest; ++bounce) {
        const Vec3d traced = radiance();
        trace_paths<s, float>(context, scratch, *now, *next, bounce);
        Path<float> path = load_path<s, float>(*now, 0);
        path.part = now->part[0];
        path.dispersed = now->dispersed[0];
        load_importance<float>(scratch, *context.scene, path, true);
        ReplayedVertex vertex{bounce, path, load_hit<float>(scratch.hits, 0), {}, {}};
        vertex.panes = to_float(radiance() - traced);
        vertex.step = scatter<s, float>(*context.scene, context.settings, vertex.path, vertex.hit, bounce, true);
        const SeenBackground<float> background = seen_background<float>(*context.scene, scratch, 0, true);
        vertex.past = light_past_blended<s, float>(context, vertex.path, bounce, background);
        if (background.seen && !background.stopped) vertex.step.emitted = vertex.step.emitted * background.share;
        const bool chains = samples_manifolds<s>(*context.scene);
        if (chains) {
            auto& hits = scratch.manifolds->hits;
            take_chain_hits<s, float>(*context.scene, hits, vertex.path, vertex.hit, bounce, background, true, vertex.step);
            if (hits.size > 0) vertex.shared = {hits.emitted.x[0], hits.emitted.y[0], hits.emitted.z[0]};
            hits.size = 0; // shade_paths() takes them again
        }
        shade_paths<s, float>(context, scratch, *now, *next, bounce);
        const Vec3d before = radiance();
        connect_paths<s, float>(context, scratch, bounce);
        const Vec3d connected = radiance();
        vertex.arrived = to_float(connected - before);
        if (chains) sample_manifolds<s, float>(context, scratch, *now, bounce);
        const Vec3d chained = radiance();
        vertex.chains = to_float(chained - connected);
        if (connects_light_vertices<s>(*context.scene)) add_connections<float>(context, scratch, bounce);
        vertex.light_vertices = to_float(radiance() - chained);
        if (!visit(vertex)) break;
        std::swap(now, next);
    }
    return to_float(radiance());
}

} // namespace blush
