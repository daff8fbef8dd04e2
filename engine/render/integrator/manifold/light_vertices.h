// Light vertices: bidirectional path tracing of indirect light from caustics (Veach 1997, chapter 10; Lafortune and Willems 1993,
// "Bi-directional Path Tracing"). Each path of the camera has one light path, which goes from its light through a chain of mirrors and
// smooth glass to the first Lambertian surface, the light vertex. All Lambertian vertices of the camera path are connected to it. So a
// wall beside a caustic finds its brightest parts, which it sees by chance otherwise.
//
// Manifold sampling, with its hits, finds the same light where a camera path meets the caustic's surface. A path with the last vertices x,
// y and a solution of density d at y has the density a d there, a being that of y as seen from x per area; light paths have the density e
// of their emission times the cosine at y. Weights are those of the balance heuristic: k a d / (k a d + e cos) and the rest (Veach
// 1997, section 9.2). At the fold of a caustic d vanishes, and light paths take all of it. k = LightVertexTables::walk_share; the
// probability that a walk finds the solution is not known. It, those of the chain's events and the compression of solid angles by
// refraction are left out: weights add up to 1 for any densities that both strategies agree on. So d is that of the chain traced from y,
// by the same code. Where k a d is usually small, few vertices begin walks (Russian roulette).
#pragma once

#include "render/integrator/light_path_sampling.h"
#include "render/integrator/light_paths.h"
#include "render/integrator/manifold/manifold_sampling.h"

#include <memory>

namespace blush::inline BLUSH_ISA {

// Its numbers are those of the camera path with another key.
constexpr uint32_t light_vertex_salt = 0x7e47e3c5u;

// True if paths are connected to light vertices.
template <Features S> bool connects_light_vertices(const SceneTables& scene) {
    return samples_manifolds<S>(scene) && !scene.light_vertices.empty();
}

// Emits the light path of each path in the queue of camera rays, whose k-th is slot k.
template <class F>
void emit_light_vertices(const SceneTables& scene, const PathQueue& camera, Column<uint32_t>& keys, LightVertexColumns& c, PathQueue& q) {
    for (int k = 0; k < camera.size; k += width<F>) {
        store(keys + k, load<UInt<F>>(camera.key + k) ^ light_vertex_salt);
        store(c.chain + k, Int<F>(0));
    }
    emit_light_paths<F>(scene, scene.light_vertices.emitter, keys, camera.index, camera.size, c.emitted);
    q.size = 0;
    for (const EmittedPath& e : c.emitted) {
        const auto slot = int32_t(e.index);
        c.light[slot] = e.light;
        c.target.x[slot] = e.light_position.x, c.target.y[slot] = e.light_position.y, c.target.z[slot] = e.light_position.z;
        append_emitted(e, e.flux, keys[slot], camera.index[slot], slot, q);
    }
}

// Keeps light vertices in the lanes of `arrived`.
template <class F> void keep_light_vertices(LightVertexColumns& c, const Path<F>& path, const LightPathVertex<F>& v, const Int<F>& chain,
                                            const Mask<F>& arrived) {
    const F cosine = dot(v.side.wo, v.shading.ns);
    const Vec<F> reflected = v.beta * v.bsdf.diffuse * (max(cosine, F(0.f)) * inv_pi / v.cosine);
    const Mask<F> kept = arrived && has_light(reflected) && is_finite(reflected);
    const unsigned lanes = bits(kept);
    put_int<F>(c.chain, path.slot, chain, lanes);
    put3<F>(c.origin, path.slot, offset_origin(v.surface.position, v.shading.ng * clearance(v.shading.ng, v.surface.error)), lanes);
    put3<F>(c.ns, path.slot, v.shading.ns, lanes);
    put3<F>(c.ng, path.slot, v.shading.ng, lanes);
    put3<F>(c.wi, path.slot, v.side.wo, lanes);
    put3<F>(c.reflected, path.slot, reflected, lanes);
}

// Shades the hits of the light paths in `q`, which are replaced by those that go on. Path::chain has the events so far, the last first.
template <Features S, class F>
[[gnu::flatten]] void shade_light_vertices(const KernelContext& context, TileScratch& scratch, PathQueue& q, int bounce) {
    const SceneTables& scene = *context.scene;
    const int size = q.size;
    q.size = 0;
    for (int k = 0; k < size; k += width<F>) {
        Path<F> path = load_path<S, F>(q, k);
        if constexpr (S.has(Feature::dispersion)) path.dispersed = Int<F>(0);
        const Hit<F> hit = load_hit<F>(scratch.hits, k);
        const Mask<F> active = as_mask(iota<F>() + k < size);
        const Mask<F> met = active && as_mask(hit.geometry >= 0) && !as_mask(hit.instance == sphere_instance);
        if (!any(met)) continue;
        LightPathVertex<F> v = light_vertex_at<S, F>(scene, context.settings, path, hit, met, false);
        if constexpr (S.has(Feature::links))
            if (bounce == 0 && scene.links.lit_sets) {
                const Int<F> light = gather(scratch.light_vertices->light.data, select(met, path.slot, Int<F>(0)));
                v.scatters = v.scatters && is_lit<F>(scene.links, light, v.surface.part, met);
            }
        const Int<F> events = path.chain >> chain_count_shift;
        const Mask<F> ends = v.scatters && is_lambertian<S, F>(v.bsdf);
        const Mask<F> arrived = ends && !v.shading.behind && as_mask(events > 0);
        if (any(arrived)) keep_light_vertices<F>(*scratch.light_vertices, path, v, path.chain, arrived);

        const Int<F> flags = gather_field(scene.materials.materials, &MaterialRecord::flags, v.surface.material);
        const Mask<F> chains =
            v.scatters && !ends && as_mask((flags & int32_t(material_chains)) != 0) && as_mask(events < max_chain_events);
        if (!any(chains)) continue;
        const Sampler<F> sampler{path.key, path.index};
        const uint32_t dimension = first_light_vertex_dimension + dimensions_per_light_vertex * uint32_t(bounce);
        const Pair<F> direction = sampler.pair(dimension + light_bsdf_dimension), choice = sampler.pair(dimension + light_choice_dimension);
        const BsdfSample<F> s = sample<S, F>(v.bsdf, v.shading.wo, direction.x(), direction.y(), choice.x());
        const Vec<F> wi = normalize(v.shading.frame.to_world(s.wi));
        const Mask<F> outward = dot(wi, v.shading.ng) > F(0.f), same_side = (s.wi.z > F(0.f)) == outward;
        const Mask<F> crosses = outward != (dot(v.side.wo, v.shading.ng) > F(0.f)),
                      internal = reflects_partly_within<S, F>(v.side, v.bsdf, crosses);
        path.beta = v.beta * delta_light_weight<S, F>(v, s, clamped_cosine<F>(v.shading.ng, wi), choice.x());
        path.ray = {offset_origin(v.surface.position, v.surface.error, v.shading.ng, outward), wi};
        const Int<F> before = path.chain & ((1 << chain_count_shift) - 1);
        path.chain = ((events + 1) << chain_count_shift) | (before << 1) | select(crosses, Int<F>(1), Int<F>(0));
        const Mask<F> goes_on = chains && s.valid && s.delta && same_side && !internal && has_light(path.beta) && is_finite(path.beta);
        append<S, F>(q, path, goes_on);
    }
}

// Traces the chains of the light vertices again, from their end, for the density of manifold sampling there.
template <Features S, class F> void weigh_light_vertices(const KernelContext& context, TileScratch& scratch, int paths, PathQueue& rays) {
    const LightVertexColumns& v = *scratch.light_vertices;
    for (int slot = 0; slot < paths; ++slot) {
        if (v.chain[slot] == 0) continue;
        if (const int32_t light = v.light[slot];
            light >= context.scene->manifolds.lights || context.scene->manifolds.group_of_light[light] < 0) {
            scratch.light_vertices->chain[slot] = 0;
            continue;
        }
        queue_light_vertex(scratch.manifolds->hits, v, slot);
    }
    retrace_light_vertices<S, F>(context, scratch, rays, ManifoldColumns::Traced::light_vertices);
}

// The light vertices of the paths in scratch.paths[0], which are camera rays. Overwrites the other queue.
template <Features S, class F> void trace_light_vertices(const KernelContext& context, TileScratch& scratch) {
    if (!scratch.light_vertices) scratch.light_vertices = std::make_unique<LightVertexColumns>();
    if (!scratch.manifolds) scratch.manifolds = std::make_unique<ManifoldColumns>();
    PathQueue& q = scratch.paths[1];
    emit_light_vertices<F>(*context.scene, scratch.paths[0], scratch.random, *scratch.light_vertices, q);
    for (int bounce = 0; q.size > 0; ++bounce) {
        scratch.bounce_rays += q.size;
        HitColumns& h = scratch.hits;
        trace_closest<F>(*context.accel, {q.ox, q.oy, q.oz, q.dx, q.dy, q.dz, nullptr, nullptr, other_ray_mask}, q.size,
                         bounce < coherent_light_bounces, HitArrays{h.t, h.u, h.v, h.geometry, h.instance, h.triangle});
        shade_light_vertices<S, F>(context, scratch, q, bounce);
    }
    weigh_light_vertices<S, F>(context, scratch, scratch.paths[0].size, q);
}

// Queues the connections of the paths' vertices to their light vertices.
template <Features S, class F> [[gnu::noinline, gnu::flatten]] void queue_connections(const KernelContext& context, LightVertexColumns& c,
                                                                                      const Path<F>& path, const Step<F>& step, int bounce,
                                                                                      const Mask<F>& active) {
    const ReuseVertex<F>& x = step.reuse_vertex;
    const Mask<F> starts =
        active && x.lambertian && is_left_by_light_paths<F>(*context.scene, path, bounce) && !has_flag<F>(path.chain, shares_chains);
    if (!any(starts)) return;
    const Int<F> slot = select(starts, path.slot, Int<F>(0)), events = gather(c.chain, slot) >> chain_count_shift;
    const Mask<F> lit = starts && as_mask(events > 0) && as_mask((events + (bounce + 1)) < context.settings.max_bounces);
    if (!any(lit)) return;
    const Vec<F> from = offset_origin(x.position, x.ng * x.clearance), to = load3<F>(c.origin, slot) - from;
    const F d2 = max(dot(to, to), F(1e-30f)), distance = sqrt(d2);
    const Vec<F> w = to / distance, ng = load3<F>(c.ng, slot);
    const F at_y = -dot(w, ng), pdf = cosine_hemisphere_pdf(max(dot(w, x.ns), F(0.f)));
    const F arrival = pdf * at_y / d2; // of y, from x
    Step<F> connection;
    connection.direct = step.weights.arriving * x.reflectance * load3<F>(c.reflected, slot) *
                        (arrival * light_vertex_weight<F>(*context.scene, arrival, gather(c.ratio, slot)));
    connection.shadow = {from, w};
    connection.shadow_distance = distance * (1.f - 4e-7f);
    const Mask<F> faces = at_y > F(0.f) && -dot(w, load3<F>(c.ns, slot)) > F(0.f) && dot(w, x.ng) > F(0.f) && pdf > F(0.f);
    append<F>(c.connections, connection, path.slot, lit && faces && has_light(connection.direct));
}

// Adds the light of the unoccluded connections.
template <class F> void add_connections(const KernelContext& context, TileScratch& scratch, int bounce) {
    const LightVertexColumns& c = *scratch.light_vertices;
    const ShadowQueue& q = c.connections;
    scratch.shadow_rays += q.size;
    RayArrays rays = shadow_rays_of(context, q);
    rays.masks = nullptr; // they end at surfaces, not at lights
    trace_any<F>(*context.accel, rays, q.size, false, scratch.blocked);
    for (int k = 0; k < q.size; ++k) {
        if (scratch.blocked[k]) continue;
        const int slot = q.slot[k];
        const ChainLight light{slot, c.light[slot], double(q.r[k]), double(q.g[k]), double(q.b[k])};
        if (scratch.strategies) add_by_strategy(*scratch.strategies, FoundBy::light_vertex, slot, light.r, light.g, light.b);
        add_chained(context, scratch, light, bounce + 2 + (c.chain[slot] >> chain_count_shift));
    }
}

} // namespace blush::inline BLUSH_ISA
