// Multiple importance sampling of manifold sampling (manifold_sampling.h) and of paths that hit the light by chance. Where mirrors and
// glass focus light sharply, or where Newton's method hardly finds a solution, a direction is sampled with a higher density by paths.
//
// A solution has the density q among the directions of paths. A walk finds it with the probability P, and the density of its direction is
// d P: d is that of the point of the light times the determinant. Manifold sampling gets the weight k P / (P + (1 - P) c), with
// c = min(q / d, 1) and k = 1 / max(q / d, 1), and paths get the rest: about the balance heuristic (Veach 1997, section 9.2). P is
// unknown, but trials need only be ended with the probability c after each failure: their number has the expectation
// 1 / (P + (1 - P) c). Of paths the share 1 - k counts at once; others run the same trials, and count if these end by c.
#pragma once

#include "render/integrator/blended_background.h"
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
void note_chain_starts(const KernelContext& context, ChainStartColumns& c, const Path<F>& path, const Hit<F>& hit, const Step<F>& step) {
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
        c.ratio[slot] = lane(ratio, i);
        c.arrival[slot] = lane(arrival, i);
        keep_receiver_hit<F>(c.at, slot, i, path, hit, footprint, v.lambertian);
    });
}

inline void copy_start(ChainStartColumns& to, int i, const ChainStartColumns& from, int k) {
    copy3(to.origin, i, from.origin, k);
    copy3(to.ns, i, from.ns, k);
    copy3(to.direction, i, from.direction, k);
    copy_receiver_hit(to.at, i, from.at, k);
    to.ratio[i] = from.ratio[k], to.arrival[i] = from.arrival[k];
}

// Takes the light that manifold sampling finds, too, out of the step, and queues it: of a surface or a sun. Suns may cover each other, and
// be seen past blended surfaces (blended_background.h): of several lights, one is chosen by chance.
template <Features S, class F> [[gnu::noinline]] void take_chain_hits(const SceneTables& scene, ManifoldHitColumns& c, const Path<F>& path,
                                                                      const Hit<F>& hit, int bounce, const SeenBackground<F>& background,
                                                                      const Mask<F>& active, Step<F>& step) {
    const Mask<F> chained = active && is_chain<F>(path.chain);
    if (!any(chained)) return;
    const UInt<F> random = pcg_hash(UInt<F>(path.key ^ pcg_hash(UInt<F>(path.index + uint32_t(bounce) * 0x3c6ef372u))));
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
    F lights = select(on_surface && has_light(emitted), F(1.f), F(0.f)); // that the ray finds
    if constexpr (S.has(Feature::suns)) {
        for (int i = 0; i < scene.lights.sun_count; ++i) {
            const int32_t record = scene.lights.suns[i];
            const LightRecord& sun = scene.lights.lights[record];
            const Mask<F> inside =
                chained && background.seen && in_sun_disk<F>(path.ray.direction, splat<F>(sun.position), F(sun.cone_height));
            Mask<F> in_sun = found_by_manifolds<S, F>(scene, path, Int<F>(record), inside);
            if (!any(in_sun)) continue;
            const F linked = if_linked<S, F>(scene, F(1.f), Int<F>(record), path, in_sun);
            const Vec<F> seen = path.beta * splat<F>(sun.emission) * (linked * background.share);
            in_sun = in_sun && has_light(seen);
            lights = select(in_sun, lights + 1.f, lights);
            const F choice = unit_float<F>(pcg_hash(UInt<F>(random + uint32_t(i + 1))));
            const Mask<F> chosen = in_sun && choice * lights < F(1.f);
            light = select(chosen, Int<F>(record), light);
            emitted = select<F>(chosen, seen, emitted);
            target = select<F>(chosen, path.ray.direction, target);
        }
    }
    emitted = emitted * lights;
    const Mask<F> found = lights > F(0.f);
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
    compress(c.random + k, random, lanes);
    put_all(c.target, target);
    put_all(c.emitted, emitted);
    c.size += count(found);
    for (int i = k; i < c.size; ++i) copy_start(c.start, i, c.starts, c.slot[i]);
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
        const Vec<F> target = load_all(hits.target, k), origin = load_all(hits.start.origin, k), ns = load_all(hits.start.ns, k);
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
        for (int i = 0; i < width<F> && k + i < hits.size; ++i) copy_receiver_hit(c.at, first + i, hits.start.at, k + i);
        Int<F> wavelength = Int<F>(0);
        if constexpr (S.has(Feature::dispersion)) wavelength = valid(load<Int<F>>(hits.wavelength + k));
        append_receivers<S, F>(scene, c,
                               {origin, ns, ns, splat<F>(0.f), p, slot, seeds, density, load<UInt<F>>(hits.random + k),
                                load<F>(hits.start.ratio + k), load<F>(hits.start.arrival + k), wavelength, Mask<F>(true)},
                               active);
        const Vec<F> direction = load_all(hits.start.direction, k), emitted = load_all(hits.emitted, k);
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
