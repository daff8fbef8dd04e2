// MIS of light paths with manifold sampling (path_chain.h), as light paths see it. The light vertices of a tile (LightVertexColumns) hold
// the first rough surface of each light path that has been lit by a chain: the slot is that of the path. When such a path enters a
// mirror or glass, the chain is traced again from the light vertex, for the density of manifold sampling there.
#pragma once

#include "render/integrator/manifold/manifold_sampling.h"

#include <limits>
#include <memory>

namespace blush::inline BLUSH_ISA {

// Begins the chains of the paths that lights have emitted.
template <Features S> void begin_light_chains(const SceneTables& scene, TileScratch& scratch, PathQueue& q) {
    if (!samples_manifolds<S>(scene) || !scene.manifolds.shares) return;
    if (!scratch.light_vertices) scratch.light_vertices = std::make_unique<LightVertexColumns>();
    if (!scratch.manifolds) scratch.manifolds = std::make_unique<ManifoldColumns>();
    LightVertexColumns& v = *scratch.light_vertices;
    for (int k = 0; k < q.size; ++k) {
        const EmittedPath& e = scratch.light_paths->emitted[size_t(q.slot[k])];
        if (!is_end_of_chains<float>(scene, e.light, true) || is_zero_size<float>(scene.lights, e.light)) continue;
        q.chain[k] = 1;
        v.light[q.slot[k]] = e.light;
        if constexpr (S.has(Feature::dispersion)) v.wavelength[q.slot[k]] = wavelength_step<float>(Sampler<float>{q.key[k], q.index[k]});
        v.target.x[q.slot[k]] = e.light_position.x;
        v.target.y[q.slot[k]] = e.light_position.y;
        v.target.z[q.slot[k]] = e.light_position.z;
    }
}

// Keeps light vertices in the lanes of `lit`. `wi`: towards the vertex before; `pdf`: with which paths of the camera go there.
template <class F> void keep_lit_vertices(LightVertexColumns& v, const Path<F>& path, const Surface<F>& surface,
                                          const ShadingFrame<F>& shading, const Vec<F>& wi, const F& pdf, const Mask<F>& lit) {
    const unsigned lanes = bits(lit);
    put_int<F>(v.chain, path.slot, chain_events<F>(path.chain), lanes);
    put3<F>(v.origin, path.slot, offset_origin(surface.position, shading.ng * clearance(shading.ng, surface.error)), lanes);
    put3<F>(v.ns, path.slot, shading.ns, lanes);
    put3<F>(v.wi, path.slot, wi, lanes);
    put<F>(v.pdf, path.slot, pdf, lanes);
}

// Traces the chains of the paths in `q` again that now share them. Sets LightVertexColumns::ratio to k d over LightPathVertex::hit_ratio
// behind the light vertex; infinity: the camera's paths keep this light. Overwrites `rays`.
template <Features S, class F>
void weigh_shared_chains(const KernelContext& context, TileScratch& scratch, const PathQueue& q, PathQueue& rays) {
    if (!samples_manifolds<S>(*context.scene) || !context.scene->manifolds.shares) return;
    LightVertexColumns& v = *scratch.light_vertices;
    ManifoldHitColumns& hits = scratch.manifolds->hits;
    alignas(64) int32_t shared[tile_capacity];
    for (int k = 0; k < q.size; ++k)
        if (const int slot = q.slot[k]; q.chain[k] & shares_chains && v.chain[slot] != 0) {
            shared[hits.size] = slot;
            queue_light_vertex(hits, v, slot);
        }
    const int size = hits.size;
    retrace_light_vertices<S, F>(context, scratch, rays, ManifoldColumns::Traced::light_paths);
    for (int k = 0; k < size; ++k) {
        const int slot = shared[k];
        v.ratio[slot] = v.chain[slot] != 0 ? v.ratio[slot] * walk_weight : std::numeric_limits<float>::infinity();
        v.chain[slot] = 0;
    }
}

// MIS weight of light paths that share their chains. `hit`: density of paths of the camera that hit the light, over that of light paths.
template <class F> F weight_of_shared_chains(const LightVertexColumns& v, const Path<F>& path, const F& hit, const Mask<F>& shared) {
    const F ratio = gather(v.ratio, select(shared, path.slot, Int<F>(0)));
    return select(ratio < F(infinity), 1.f / (1.f + hit * min(ratio, F(1e30f))), F(0.f));
}

} // namespace blush::inline BLUSH_ISA
