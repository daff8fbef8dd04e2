// Multiple importance sampling of manifold sampling (manifold_sampling.h) and of paths that hit the light by chance. Where mirrors and
// glass focus light sharply, or where Newton's method hardly finds a solution, a direction is sampled with a higher density by paths.
//
// A solution has the density q among the directions of paths. A walk finds it with the probability P, and the density of its direction is
// d P: d is that of the point of the light times the determinant. Manifold sampling gets the weight k P / (P + (1 - P) c), with
// c = min(q / d, 1) and k = 1 / max(q / d, 1), and paths get the rest: about the balance heuristic (Veach 1997, section 9.2). P is
// unknown, but trials need only be ended with the probability c after each failure: their number has the expectation
// 1 / (P + (1 - P) c). Of paths the share 1 - k counts at once; others run the same trials, and count if these end by c.
#pragma once

#include "render/integrator/manifold/manifold_receivers.h"
#include "render/integrator/surface.h"

namespace blush::inline BLUSH_ISA {

// Of densities: where paths have less, they get no weight, so that most of them need no trials.
constexpr float least_hit_ratio = 1.f / 16;

// c and k above, from q and d.
template <class F> struct HitShare { F coin, kept; };
template <class F> HitShare<F> share_of_hits(const F& path_density, const F& density) {
    const F ratio = path_density / max(density, F(1e-30f));
    return {select(ratio < F(least_hit_ratio), F(0.f), min(ratio, F(1.f))), 1.f / max(ratio, F(1.f))};
}

// Keeps where the chains of paths that go on from a rough vertex begin. `hit`: of path.ray.
template <Features S, class F>
void note_chain_starts(const KernelContext& context, ManifoldHitColumns& c, const Path<F>& path, const Hit<F>& hit, const Step<F>& step) {
    const Mask<F> begins = step.continues && chain_begins<F>(step.next.chain);
    if (!any(begins)) return;
    const ReuseVertex<F>& v = step.reuse_vertex;
    const F arrival = arrival_density<F>(*context.scene, path, v), footprint = receiver_width<S, F>(context, path, hit);
    // Receivers of hits have the shading normal alone.
    const Vec<F>& wi = step.next.ray.direction;
    const F ratio = light_ratio_behind<F>(path, v) * clamped_cosine<F>(v.ng, wi) / clamped_cosine<F>(v.ns, wi);
    for_each_lane(bits(begins), [&](int i) {
        const int slot = lane(path.slot, i);
        const auto keep = [&](Columns3& column, const Vec<F>& v) {
            column.x[slot] = lane(v.x, i);
            column.y[slot] = lane(v.y, i);
            column.z[slot] = lane(v.z, i);
        };
        keep(c.origin, step.next.ray.origin);
        keep(c.direction, step.next.ray.direction);
        keep(c.ns, v.ns);
        c.start_ratio[slot] = lane(ratio, i);
        c.start_arrival[slot] = lane(arrival, i);
        keep_receiver_hit<F>(c.at, slot, i, path, hit, footprint, v.lambertian);
    });
}

// Takes the light that manifold sampling finds, too, out of the step, and queues it.
template <Features S, class F> [[gnu::noinline]] void take_chain_hits(const SceneTables& scene, ManifoldHitColumns& c, const Path<F>& path,
                                                                      const Hit<F>& hit, int bounce, const Mask<F>& active, Step<F>& step) {
    const Mask<F> chained = active && is_chain<F>(path.chain);
    if (!any(chained)) return;
    Int<F> light = Int<F>(-1);
    Vec<F> emitted = step.emitted, target = path.ray.origin + path.ray.direction * hit.t;
    const Mask<F> met = chained && as_mask(hit.geometry >= 0), sphere = met && as_mask(hit.instance == sphere_instance);
    const Mask<F> triangle = met && !sphere;
    if constexpr (S.has(Feature::sphere_lights)) light = select(sphere, hit.triangle + scene.lights.first_sphere, light);
    if constexpr (S.has(Feature::emissive_triangles))
        if (any(triangle)) {
            const Int<F> part = select(triangle, part_of<S, F>(scene, hit, triangle), Int<F>(0));
            light = select(triangle, light_of_triangle<F>(scene, part, select(triangle, hit.triangle, Int<F>(0))), light);
        }
    const Mask<F> on_surface = found_by_manifolds<S, F>(scene, path, light, met);
    step.emitted = select<F>(on_surface, splat<F>(0.f), step.emitted);
    Mask<F> found = on_surface;
    if constexpr (S.has(Feature::suns)) {
        for (int i = 0; i < scene.lights.sun_count; ++i) {
            const int32_t record = scene.lights.suns[i];
            const LightRecord& sun = scene.lights.lights[record];
            const Mask<F> inside = chained && !met && in_sun_disk<F>(path.ray.direction, splat<F>(sun.position), F(sun.cone_height));
            const Mask<F> in_sun = found_by_manifolds<S, F>(scene, path, Int<F>(record), inside);
            light = select(in_sun, Int<F>(record), light);
            const F linked = if_linked<S, F>(scene, F(1.f), Int<F>(record), path, in_sun);
            emitted = select<F>(in_sun, path.beta * splat<F>(sun.emission) * linked, emitted);
            target = select<F>(in_sun, path.ray.direction, target);
            found = found || in_sun;
        }
    }
    found = found && has_light(emitted);
    const unsigned lanes = bits(found);
    if (lanes == 0) return;
    const int k = c.size;
    const auto put_all = [&](Columns3& column, const Vec<F>& vector) {
        compress(column.x + k, vector.x, lanes);
        compress(column.y + k, vector.y, lanes);
        compress(column.z + k, vector.z, lanes);
    };
    compress(c.slot + k, path.slot, lanes);
    compress(c.light + k, light, lanes);
    compress(c.chain + k, chain_events<F>(path.chain), lanes);
    if constexpr (S.has(Feature::dispersion)) compress(c.wavelength + k, wavelength_step<F>(Sampler<F>{path.key, path.index}), lanes);
    compress(c.random + k, pcg_hash(UInt<F>(path.key ^ pcg_hash(UInt<F>(path.index + uint32_t(bounce) * 0x3c6ef372u)))), lanes);
    put_all(c.target, target);
    put_all(c.emitted, emitted);
    c.size += count(found);
}

// Queues the receivers of the hits.
template <Features S, class F> void add_hit_receivers(const SceneTables& scene, ManifoldColumns& c) {
    const ManifoldTables& t = scene.manifolds;
    const ManifoldHitColumns& hits = c.hits;
    const auto load_all = [](const Columns3& column, int k) {
        return Vec<F>{load<F>(column.x + k), load<F>(column.y + k), load<F>(column.z + k)};
    };
    for (int k = 0; k < hits.size; k += width<F>) {
        const Mask<F> active = as_mask(iota<F>() + k < hits.size);
        const auto valid = [&](const Int<F>& i) { return select(active, i, Int<F>(0)); };
        const Int<F> slot = valid(load<Int<F>>(hits.slot + k)), light = valid(load<Int<F>>(hits.light + k));
        const Vec<F> target = load_all(hits.target, k), origin = load3<F>(hits.origin, slot), ns = load3<F>(hits.ns, slot);
        LightPoint<F> p = chain_light_point<S, F>(scene, light, F(0.5f), F(0.5f), active);
        if constexpr (S.has(Feature::sphere_lights)) {
            const Vec<F> center = gather_field3<F>(scene.lights.lights, &LightRecord::position, light);
            p.normal = select<F>(has_kind(p, LightKind::sphere), normalize(target - center), p.normal);
        }
        p.position = target;
        const Int<F> group = valid(gather(t.group_of_light, light));
        const GroupSeeds<F> seeds = seeds_of_group<F>(t, region_at<F>(t, origin, ns, active), group, active);
        const F density = seeds.probability * p.density / to_float(gather_field(t.groups, &ManifoldGroup::lights, group));
        const int first = c.size;
        for (int i = 0; i < width<F> && k + i < hits.size; ++i) copy_receiver_hit(c.at, first + i, hits.at, hits.slot[k + i]);
        Int<F> wavelength = Int<F>(0);
        if constexpr (S.has(Feature::dispersion)) wavelength = valid(load<Int<F>>(hits.wavelength + k));
        append_receivers<S, F>(scene, c,
                               {origin, ns, ns, splat<F>(0.f), p, slot, seeds, density, load<UInt<F>>(hits.random + k),
                                gather(hits.start_ratio, slot), gather(hits.start_arrival, slot), wavelength, Mask<F>(true)},
                               active);
        const Vec<F> direction = load3<F>(hits.direction, slot), emitted = load_all(hits.emitted, k);
        const auto put_all = [&](Columns3& column, const Vec<F>& v) {
            store(column.x + first, v.x);
            store(column.y + first, v.y);
            store(column.z + first, v.z);
        };
        put_all(c.root, direction);
        put_all(c.found, emitted);
        store(c.root_chain + first, load<Int<F>>(hits.chain + k));
        store(c.kind + first, load<Int<F>>(c.kind + first) | int32_t(receiver_hit));
    }
}

} // namespace blush::inline BLUSH_ISA
