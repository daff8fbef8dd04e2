// Light passing thin, smooth, transmissive walls (window glass: in glTF, transmission without volume, roughness 0) without
// refraction. Such a wall is a null interaction: path rays and shadow rays continue in a straight line, times the wall's
// transmittance T = (1 - F) tint (Cycles: transparent shadows). The path keeps the origin, pdf and bounce count of its last real
// vertex, so MIS weights an emitter behind panes against NEE through the same panes, and lights of zero size illuminate through
// windows exactly.
//
// At a pane a path passes with the probability p with which the BSDF samples its straight lobe, and then carries T / p. Otherwise
// scatter() samples the other lobes (estimator.h).
#pragma once

#include "render/integrator/estimator.h"
#include "render/integrator/path_queues.h"

#include <algorithm>
#include <utility>

namespace blush::inline BLUSH_ISA {

// Sampler dimensions for the decision to pass: one pair per bounce, separate from those of scattering events.
constexpr uint32_t first_pane_dimension = 1u << 30;

// A pane at the hit point of a ray.
template <class F> struct PanePoint {
    StraightTransmission<F> through;
    Vec<F> position, error, ng; // origin of the continued ray; ng on the ray's side
    Vec<F> emission;            // nits towards the ray
    Vec<F> albedo, ns;
    Mask<F> emits;
    F facing; // cosine between ray and plane
    Int<F> part, object, material;
};
// `cone`: texture footprint in metres (ray_cone.h).
template <Features S, class F> [[gnu::noinline]] PanePoint<F> pane_at(const SceneTables& scene, const EnergyTable* energy,
                                                                      const Vec<F>& direction, const Hit<F>& hit, const F& cone,
                                                                      const Mask<F>& active) {
    const Surface<F> surface = surface_at<S, F>(scene, hit, active, cone);
    MaterialPoint<F> material = material_at<S, F>(scene.materials, surface.material, surface.texture, surface.color, active);
    const Vec<F> wo_world = -direction;
    const F outside = dot(surface.ng, wo_world);
    const Mask<F> front = outside > F(0.f);
    const ShadingFrame<F> shading = shading_frame_at<S, F>(surface, material, wo_world, front, Mask<F>(false));
    const Bsdf<F> bsdf = make_bsdf<S, F>(material.bsdf, shading.wo, energy);
    PanePoint<F> p;
    p.through = straight_transmission<S, F>(bsdf, shading.wo);
    p.position = surface.position;
    p.error = surface.error;
    p.ng = shading.ng;
    p.facing = abs(outside);
    p.emission = material.emission;
    if constexpr (S.has(Feature::clearcoat)) p.emission = p.emission * through_clearcoat(material.bsdf.layers.clearcoat, p.facing);
    p.emits = active && max_component(material.emission) > F(0.f) && (front || material.double_sided);
    p.albedo = albedo<S, F>(bsdf, shading.wo);
    p.ns = shading.ns;
    p.part = surface.part;
    p.object = gather_field(scene.parts, &PartRecord::object, surface.part);
    p.material = surface.material;
    return p;
}

// ---- path rays

// Loads path `index` of the queue in each lane of `active`; other lanes load an arbitrary path of it.
template <Features S, class F> Path<F> gather_path(const PathQueue& q, const Int<F>& index, const Mask<F>& active) {
    const Int<F> i = select(active, index, Int<F>(0));
    Path<F> p;
    p.ray.origin = {gather(q.ox.data, i), gather(q.oy.data, i), gather(q.oz.data, i)};
    p.ray.direction = {gather(q.dx.data, i), gather(q.dy.data, i), gather(q.dz.data, i)};
    p.beta = {gather(q.beta_r.data, i), gather(q.beta_g.data, i), gather(q.beta_b.data, i)};
    p.pdf = gather(q.pdf.data, i);
    p.normal = splat<F>(0.f);
    if constexpr (S.has(Feature::light_tree)) p.normal = {gather(q.nx.data, i), gather(q.ny.data, i), gather(q.nz.data, i)};
    p.cone = F(0.f);
    if constexpr (S.has(Feature::textures)) p.cone = gather(q.cone.data, i);
    p.key = gather(q.key.data, i);
    p.index = gather(q.index.data, i);
    p.slot = gather(q.slot.data, i);
    if constexpr (S.has(Feature::links)) p.part = gather(q.part.data, i);
    p.light_ratio = p.emission_ratio = F(0.f);
    p.chain = Int<F>(0);
    if constexpr (S.has(Feature::light_paths)) {
        p.light_ratio = gather(q.light_ratio.data, i);
        p.emission_ratio = gather(q.emission_ratio.data, i);
        p.chain = gather(q.chain.data, i);
    }
    return p;
}

// Continues those paths `index` of `now` that pass the pane they hit: their continued rays are appended to `rest`, with the path
// index as slot and the distance so far as pdf. `hit`: t from the path's own origin.
template <Features S, class F> void pass_panes(const KernelContext& context, TileScratch& scratch, PathQueue& now, PathQueue& rest,
                                               const Int<F>& index, const Hit<F>& hit, const PathRays& rays, const Mask<F>& active) {
    const SceneTables& scene = *context.scene;
    const Mask<F> pane = is_pane<S, F>(scene, hit, active);
    if (!any(pane)) return;
    const Path<F> path = gather_path<S, F>(now, index, pane);
    F cone = F(0.f);
    if constexpr (S.has(Feature::textures))
        if (rays.from_camera) cone = pane_width<F>(cone_width<F>(scene.camera, context.settings, path, hit.t), rays.bounce);
    const PanePoint<F> p = pane_at<S, F>(scene, context.settings.energy, path.ray.direction, hit, cone, pane);

    Column<int32_t>& passed = scratch.panes->passed;
    const Int<F> number = gather(passed.data, select(pane, index, Int<F>(0)));
    const Sampler<F> sampler{UInt<F>(path.key ^ pcg_hash(to_unsigned(number))), path.index};
    const Mask<F> passes = pane && sampler.pair(first_pane_dimension + uint32_t(rays.bounce)).x() < p.through.probability;
    if (!any(passes)) return;

    // Paths that do not pass get the pane's emission in scatter().
    const Mask<F> emits = passes && p.emits;
    if (rays.from_camera && any(emits)) {
        const EmissionPlace<F> at{p.part, p.position, p.ng};
        const EmissionHit<F> found = emission_hit<S, F>(scene, context.settings.mis, path, at, hit, p.facing, p.emission, emits);
        const Vec<F> light = path.beta * found.radiance * found.weight;
        for_each_lane(bits(emits), [&](int i) {
            const int slot = lane(path.slot, i);
            const double r = double(lane(light.x, i)), g = double(lane(light.y, i)), b = double(lane(light.z, i));
            scratch.r[slot] += r;
            scratch.g[slot] += g;
            scratch.b[slot] += b;
            if (scratch.groups) scratch.groups->add(scene.groups.of_part[lane(p.part, i)], slot, r, g, b);
            if (scratch.strategies) add_hit_by_strategy(*scratch.strategies, slot, r, g, b);
        });
    }
    const F over = 1.f / select(passes, p.through.probability, F(1.f));
    const Vec<F> beta = path.beta * p.through.value * over;
    for_each_lane(bits(passes), [&](int i) {
        const int k = lane(index, i);
        // First-hit planes show the pane.
        if (rays.from_camera && rays.bounce == 0 && scratch.first && passed[k] == 0) {
            FirstHitColumns& c = *scratch.first;
            c.albedo_r[k] = lane(p.albedo.x, i);
            c.albedo_g[k] = lane(p.albedo.y, i);
            c.albedo_b[k] = lane(p.albedo.z, i);
            c.normal_x[k] = lane(p.ns.x, i);
            c.normal_y[k] = lane(p.ns.y, i);
            c.normal_z[k] = lane(p.ns.z, i);
            c.depth[k] = lane(hit.t, i);
            c.object[k] = lane(p.object, i);
            c.material[k] = lane(p.material, i);
        }
        ++passed[k];
        now.beta_r[k] = lane(beta.x, i);
        now.beta_g[k] = lane(beta.y, i);
        now.beta_b[k] = lane(beta.z, i);
        // Chains of manifold sampling pass no panes.
        if constexpr (S.has(Feature::light_paths)) now.chain[k] &= chain_flags;
    });
    const Vec<F> from = offset_origin(p.position, p.error, p.ng, Mask<F>(false));
    const unsigned b = bits(passes);
    const int n = rest.size;
    compress(rest.ox + n, from.x, b);
    compress(rest.oy + n, from.y, b);
    compress(rest.oz + n, from.z, b);
    compress(rest.dx + n, path.ray.direction.x, b);
    compress(rest.dy + n, path.ray.direction.y, b);
    compress(rest.dz + n, path.ray.direction.z, b);
    compress(rest.pdf + n, hit.t, b);
    compress(rest.key + n, path.key, b);
    compress(rest.index + n, path.index, b);
    compress(rest.slot + n, index, b);
    rest.size += count(passes);
}

// Call after `now` was traced: replaces the hits of paths that pass panes by the first hits behind them, t still from the path's
// origin. Overwrites `rest`.
template <Features S, class F>
void trace_through_panes(const KernelContext& context, TileScratch& scratch, PathQueue& now, PathQueue& rest, const PathRays& rays) {
    if (!scratch.panes) scratch.panes = std::make_unique<PaneColumns>();
    PaneColumns& panes = *scratch.panes;
    std::fill_n(panes.passed.data, now.size, 0);
    rest.size = 0;
    for (int k = 0; k < now.size; k += width<F>) {
        const Int<F> index = iota<F>() + k;
        pass_panes<S, F>(context, scratch, now, rest, index, load_hit<F>(scratch.hits, k), rays, as_mask(index < now.size));
    }
    // Each iteration advances each ray by one surface.
    for (int round = 0; rest.size > 0 && round < max_path_length; ++round) {
        scratch.bounce_rays += rest.size;
        trace_rays<F>(context, scratch.random, rest, rays, panes.hits);
        const int count = std::exchange(rest.size, 0);
        for (int k = 0; k < count; k += width<F>) {
            const Mask<F> active = as_mask(iota<F>() + k < count);
            const Int<F> index = load<Int<F>>(rest.slot + k);
            Hit<F> hit = load_hit<F>(panes.hits, k);
            hit.t = hit.t + load<F>(rest.pdf + k);
            for_each_lane(bits(active), [&](int i) {
                const int at = lane(index, i);
                scratch.hits.t[at] = lane(hit.t, i);
                scratch.hits.u[at] = lane(hit.u, i);
                scratch.hits.v[at] = lane(hit.v, i);
                scratch.hits.geometry[at] = lane(hit.geometry, i);
                scratch.hits.instance[at] = lane(hit.instance, i);
                scratch.hits.triangle[at] = lane(hit.triangle, i);
            });
            // never appends beyond the entries already read
            pass_panes<S, F>(context, scratch, now, rest, index, hit, rays, active);
        }
    }
}

// ---- shadow rays

// Continues the queue's shadow rays from k on behind the panes that they hit, attenuated; rays without remaining light, or that
// hit anything else, end. Appends to the queue, which must hold no more than k rays.
template <Features S, class F>
void move_shadow_rays(const KernelContext& context, TileScratch& scratch, Connects to, int k, const Hit<F>& hit, const Mask<F>& active) {
    ShadowQueue& q = scratch.shadows;
    const Mask<F> pane = is_pane<S, F>(*context.scene, hit, active);
    if (!any(pane)) return;
    const Vec<F> origin{load<F>(q.ox + k), load<F>(q.oy + k), load<F>(q.oz + k)},
        direction{load<F>(q.dx + k), load<F>(q.dy + k), load<F>(q.dz + k)};
    const F distance = load<F>(q.distance + k);
    const PanePoint<F> p = pane_at<S, F>(*context.scene, context.settings.energy, direction, hit, F(0.f), pane);
    Step<F> s;
    s.direct = Vec<F>{load<F>(q.r + k), load<F>(q.g + k), load<F>(q.b + k)} * p.through.value;
    s.shadow = {offset_origin(p.position, p.error, p.ng, Mask<F>(false)), direction};
    // The remaining distance, again short of the light's plane: rounding must not lengthen it.
    const F left = (distance - dot(s.shadow.origin - origin, direction)) * (1.f - 4e-7f);
    s.shadow_distance = select(distance == F(infinity), distance, max(left, F(0.f)));
    const Int<F> slot = load<Int<F>>(q.slot + k);
    const Mask<F> goes_on = pane && has_light(s.direct);
    const unsigned b = bits(goes_on);
    if (context.scene->blends) compress(q.random + q.size, load<UInt<F>>(q.random + k), b);
    if (to == Connects::to_camera) {
        LightPathColumns& splats = *scratch.light_paths;
        compress(splats.x + q.size, load<F>(splats.x + k), b);
        compress(splats.y + q.size, load<F>(splats.y + k), b);
        if (splats.measures) compress(splats.others + q.size, load<F>(splats.others + k), b);
    } else {
        if (scratch.groups) compress(q.group + q.size, load<Int<F>>(q.group + k), b);
        if (scratch.trials) compress(q.trial + q.size, load<Int<F>>(q.trial + k), b);
        if (context.scene->links.lit_sets) compress(q.mask + q.size, load<UInt<F>>(q.mask + k), b);
    }
    append<F>(q, s, slot, goes_on);
}

// Closest hits of the queue's shadow rays on all but blended surfaces, whose transmittance up to there dims their light. Panes that
// are blended are met by chance: a ray that hits one goes on, times the pane's transmittance, and must not be dimmed as well.
template <Features S, class F> void trace_past_blended(const KernelContext& context, TileScratch& scratch, Connects to, bool coherent) {
    ShadowQueue& q = scratch.shadows;
    HitColumns& h = scratch.hits;
    RayArrays rays = connection_rays(context, q, to);
    context.accel->intersect_unblended(rays, q.size, coherent, {h.t, h.u, h.v, h.geometry, h.instance, h.triangle});
    if (!scratch.panes) scratch.panes = std::make_unique<PaneColumns>();
    Column<float>&end = scratch.panes->hits.t, &share = scratch.panes->hits.u;
    for (int k = 0; k < q.size; k += width<F>) {
        const Hit<F> hit = load_hit<F>(h, k);
        const Mask<F> pane = is_pane<S, F>(*context.scene, hit, as_mask(iota<F>() + k < q.size));
        // Ends before the pane. Rays that are blocked need not be traced: a negative distance.
        const F before_hit = select(pane, hit.t * (1.f - 4e-7f), F(-1.f));
        store(end + k, select(as_mask(hit.geometry < 0), load<F>(q.distance + k), before_hit));
    }
    rays.far_distance = end;
    context.accel->transmittance(rays, q.size, coherent, share);
    for (int k = 0; k < q.size; ++k) dim_shadow_light(scratch, k, share[k]);
}

// Calls arrive(k) for all shadow rays k that reach their end through any number of panes. Empties the queue. `coherent`: the first rays.
template <Features S, class F, class Arrive>
void connect_through_panes(const KernelContext& context, TileScratch& scratch, Connects to, bool coherent, const Arrive& arrive) {
    ShadowQueue& q = scratch.shadows;
    HitColumns& h = scratch.hits;
    for (int round = 0; q.size > 0 && round < max_path_length; ++round) {
        if (round > 0) scratch.shadow_rays += q.size;
        const bool side_by_side = coherent && round == 0;
        if (context.scene->blends)
            trace_past_blended<S, F>(context, scratch, to, side_by_side);
        else
            trace_closest<F>(*context.accel, connection_rays(context, q, to), q.size, side_by_side,
                             {h.t, h.u, h.v, h.geometry, h.instance, h.triangle});
        const int count = std::exchange(q.size, 0);
        for (int k = 0; k < count; k += width<F>) {
            const Mask<F> active = as_mask(iota<F>() + k < count);
            const Hit<F> hit = load_hit<F>(h, k);
            const Mask<F> arrives = active && as_mask(hit.geometry < 0);
            for_each_lane(bits(arrives), [&](int i) { arrive(k + i); });
            move_shadow_rays<S, F>(context, scratch, to, k, hit, active);
        }
    }
}

// Calls arrive(k) for all shadow rays k of the queue that are not blocked, with the light that is left. `coherent`: they are side by side.
template <Features S, class F, class Arrive>
void connect_rays(const KernelContext& context, TileScratch& scratch, Connects to, bool coherent, const Arrive& arrive) {
    if constexpr (S.has(Feature::transmission))
        if (context.scene->panes) return connect_through_panes<S, F>(context, scratch, to, coherent, arrive);
    const ShadowQueue& q = scratch.shadows;
    const RayArrays rays = connection_rays(context, q, to);
    if (context.scene->blends) {
        const float* share = scratch.hits.t; // free: the bounce's hits are shaded
        context.accel->transmittance(rays, q.size, coherent, scratch.hits.t);
        for (int k = 0; k < q.size; ++k) {
            if (!(share[k] > 0)) continue;
            dim_shadow_light(scratch, k, share[k]);
            arrive(k);
        }
        return;
    }
    trace_any<F>(*context.accel, rays, q.size, coherent, scratch.blocked);
    for (int k = 0; k < q.size; ++k)
        if (!scratch.blocked[k]) arrive(k);
}

} // namespace blush::inline BLUSH_ISA
