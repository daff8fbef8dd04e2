// A tile of paths, stage by stage: generate, trace, shade, trace shadows, and again with the survivors, compacted in order.
#pragma once

#include "render/estimator.h"
#include "render/group_sums.h"
#include "render/kernels/kernel.h"
#include "render/path_reuse.h"

#include <algorithm>
#include <utility>

namespace blush::inline BLUSH_ISA {

template <Features S, class F> Path<F> load_path(const PathQueue& q, int k) {
    Path<F> p;
    p.ray.origin = {load<F>(q.ox + k), load<F>(q.oy + k), load<F>(q.oz + k)};
    p.ray.direction = {load<F>(q.dx + k), load<F>(q.dy + k), load<F>(q.dz + k)};
    p.beta = {load<F>(q.beta_r + k), load<F>(q.beta_g + k), load<F>(q.beta_b + k)};
    p.pdf = load<F>(q.pdf + k);
    p.normal = splat<F>(0.f);
    if constexpr (S.has(Feature::light_tree)) p.normal = {load<F>(q.nx + k), load<F>(q.ny + k), load<F>(q.nz + k)};
    p.cone = F(0.f);
    if constexpr (S.has(Feature::textures)) p.cone = load<F>(q.cone + k);
    p.key = load<UInt<F>>(q.key + k);
    p.index = load<UInt<F>>(q.index + k);
    p.slot = load<Int<F>>(q.slot + k);
    return p;
}

template <Features S, class F> void append(PathQueue& q, const Path<F>& p, const Mask<F>& lanes) {
    const unsigned b = bits(lanes);
    const int k = q.size;
    compress(q.ox + k, p.ray.origin.x, b);
    compress(q.oy + k, p.ray.origin.y, b);
    compress(q.oz + k, p.ray.origin.z, b);
    compress(q.dx + k, p.ray.direction.x, b);
    compress(q.dy + k, p.ray.direction.y, b);
    compress(q.dz + k, p.ray.direction.z, b);
    compress(q.beta_r + k, p.beta.x, b);
    compress(q.beta_g + k, p.beta.y, b);
    compress(q.beta_b + k, p.beta.z, b);
    compress(q.pdf + k, p.pdf, b);
    if constexpr (S.has(Feature::light_tree)) {
        compress(q.nx + k, p.normal.x, b);
        compress(q.ny + k, p.normal.y, b);
        compress(q.nz + k, p.normal.z, b);
    }
    if constexpr (S.has(Feature::textures)) compress(q.cone + k, p.cone, b);
    compress(q.key + k, p.key, b);
    compress(q.index + k, p.index, b);
    compress(q.slot + k, p.slot, b);
    q.size += count(lanes);
}

template <class F> void append(ShadowQueue& q, const Step<F>& s, const Int<F>& slot, const Mask<F>& lanes) {
    const unsigned b = bits(lanes);
    const int k = q.size;
    compress(q.ox + k, s.shadow.origin.x, b);
    compress(q.oy + k, s.shadow.origin.y, b);
    compress(q.oz + k, s.shadow.origin.z, b);
    compress(q.dx + k, s.shadow.direction.x, b);
    compress(q.dy + k, s.shadow.direction.y, b);
    compress(q.dz + k, s.shadow.direction.z, b);
    compress(q.distance + k, s.shadow_distance, b);
    compress(q.r + k, s.direct.x, b);
    compress(q.g + k, s.direct.y, b);
    compress(q.b + k, s.direct.z, b);
    compress(q.slot + k, slot, b);
    q.size += count(lanes);
}

// The random number of a ray for stochastic opacity; salt tells the rays of one path apart: 2 * bounce, and 2 * bounce + 1 of its shadow ray.
template <class F> UInt<F> opacity_random(const UInt<F>& key, const UInt<F>& index, uint32_t salt) {
    return key ^ pcg_hash(UInt<F>(index + salt * 0x9e3779b9u));
}

template <class F> Hit<F> load_hit(const HitColumns& h, int k) {
    return {load<F>(h.t + k),           load<F>(h.u + k),          load<F>(h.v + k), load<Int<F>>(h.geometry + k), load<Int<F>>(h.instance + k),
            load<Int<F>>(h.triangle + k)};
}

template <class F> void store_first_hit(FirstHitColumns& c, int k, const FirstHit<F>& first) {
    // At bounce 0 nothing has been compacted: the k-th path is slot k.
    store(c.albedo_r + k, first.albedo.x);
    store(c.albedo_g + k, first.albedo.y);
    store(c.albedo_b + k, first.albedo.z);
    store(c.normal_x + k, first.normal.x);
    store(c.normal_y + k, first.normal.y);
    store(c.normal_z + k, first.normal.z);
    store(c.depth + k, first.depth);
    store(c.object + k, first.object);
    store(c.material + k, first.material);
}

template <class F> void add_light(TileScratch& scratch, const int32_t* slots, const Vec<F>& radiance, const Mask<F>& lanes) {
    for_each_lane(bits(lanes), [&](int i) {
        const int slot = slots[i];
        scratch.r[slot] += double(lane(radiance.x, i));
        scratch.g[slot] += double(lane(radiance.y, i));
        scratch.b[slot] += double(lane(radiance.z, i));
    });
}

template <class F> void note_roulette(RouletteColumns& c, const int32_t* slots, const Step<F>& step, const Mask<F>& active, int bounce) {
    const Mask<F> asked = step.weights.asked;
    for_each_lane(bits(active), [&](int i) { c.length[slots[i]] += 1; });
    for_each_lane(bits(asked), [&](int i) {
        c.asked[slots[i]] += 1;
        c.survival[slots[i]] += lane(step.weights.survival, i);
    });
    PathCounts& counts = c.counts[std::min(bounce, most_counted_bounces - 1)];
    counts.alive += count(active);
    counts.asked += count(asked);
    counts.survived += count(asked && (step.continues || step.breaks));
}

template <Features S, class F> [[gnu::flatten]] void generate_paths(const KernelContext& context, const TileJob& job, TileScratch& scratch) {
    PathQueue& q = scratch.paths[0];
    // Pixel and sample of each slot, by plain counting; the columns that will hold the rays serve as scratch.
    float* xs = scratch.hits.t;
    float* ys = scratch.hits.u;
    uint32_t* samples = scratch.random;
    int n = 0;
    for (int y = 0; y < job.height; ++y)
        for (int x = 0; x < job.width; ++x)
            for (int s = 0; s < job.samples; ++s, ++n) {
                xs[n] = float(job.x + x);
                ys[n] = float(job.y + y);
                samples[n] = uint32_t(job.sample(s));
            }
    const uint32_t half[2] = {randomisation(context.seed, 0), randomisation(context.seed, 1)};
    q.size = 0;
    for (int k = 0; k < n; k += width<F>) {
        const F x = load<F>(xs + k), y = load<F>(ys + k);
        const UInt<F> sample = load<UInt<F>>(samples + k);
        const UInt<F> odd = sample & 1u;
        const UInt<F> random = select(as_mask(odd != 0u), UInt<F>(half[1]), UInt<F>(half[0]));
        UInt<F> key = pixel_key<F>(to_unsigned(to_int(x)), to_unsigned(to_int(y)), random), index = sample >> 1;
        if (context.settings.sampler == SampleNumbers::random) {
            key = independent_key(key, index);
            index = UInt<F>(0u);
        }
        const Int<F> slot = iota<F>() + k;
        if constexpr (S.has(Feature::links)) store(q.part + q.size, Int<F>(from_camera));
        if constexpr (S.has(Feature::dispersion)) store(q.dispersed + q.size, Int<F>(0));
        append<S, F>(q, begin_path<S, F>(*context.scene, context.settings, x, y, key, index, slot), as_mask(slot < n));
    }
    std::fill_n(scratch.r.data, n, 0.0);
    std::fill_n(scratch.g.data, n, 0.0);
    std::fill_n(scratch.b.data, n, 0.0);
    if (scratch.groups) scratch.groups->clear(n);
    if (!scratch.roulette) return;
    std::fill_n(scratch.roulette->length.data, n, 0.f);
    std::fill_n(scratch.roulette->asked.data, n, 0.f);
    std::fill_n(scratch.roulette->survival.data, n, 0.f);
}

template <class F> void trace_paths(const KernelContext& context, TileScratch& scratch, const PathQueue& q, int bounce) {
    const bool alpha = context.accel->has_alpha();
    if (alpha)
        for (int k = 0; k < q.size; k += width<F>)
            store(scratch.random + k, opacity_random<F>(load<UInt<F>>(q.key + k), load<UInt<F>>(q.index + k), uint32_t(2 * bounce)));
    const RayArrays rays{q.ox, q.oy, q.oz, q.dx, q.dy, q.dz, nullptr, alpha ? scratch.random.data : nullptr,
                         bounce == 0 ? camera_ray_mask : other_ray_mask};
    HitColumns& h = scratch.hits;
    context.accel->intersect(rays, q.size, bounce == 0, {h.t, h.u, h.v, h.geometry, h.instance, h.triangle});
}

template <Features S, class F>
[[gnu::flatten]] void shade_paths(const KernelContext& context, TileScratch& scratch, const PathQueue& now, PathQueue& next, int bounce) {
    next.size = 0;
    scratch.shadows.size = 0;
    const bool alpha = context.accel->has_alpha();
    for (int k = 0; k < now.size; k += width<F>) {
        Path<F> path = load_path<S, F>(now, k);
        if constexpr (S.has(Feature::links)) path.part = load<Int<F>>(now.part + k);
        if constexpr (S.has(Feature::dispersion)) path.dispersed = load<Int<F>>(now.dispersed + k);
        const Mask<F> active = as_mask(iota<F>() + k < now.size);
        const Step<F> step = scatter<S, F>(*context.scene, context.settings, path, load_hit<F>(scratch.hits, k), bounce, active);
        if (bounce == 0 && scratch.first) store_first_hit<F>(*scratch.first, k, step.first);
        if (bounce <= 1 && context.settings.reuse.size() > 1) store_junction<F>(*scratch.reuse, now, k, bounce, path, step.junction);
        if (scratch.roulette) note_roulette<F>(*scratch.roulette, now.slot + k, step, active, bounce);
        if (any(step.emits)) add_light<F>(scratch, now.slot + k, step.emitted, step.emits);
        if (scratch.groups && any(step.emits)) add_found_by_group<S, F>(context, *scratch.groups, scratch.hits, k, path, step, bounce);
        if (any(step.breaks)) add_light<F>(scratch, now.slot + k, step.next.beta, step.breaks);
        if (any(step.connects)) {
            if (alpha)
                compress(scratch.shadows.random + scratch.shadows.size, opacity_random<F>(path.key, path.index, uint32_t(2 * bounce + 1)),
                         bits(step.connects));
            if (scratch.groups) {
                const Int<F> light = select(step.connects, step.light, Int<F>(0));
                compress(scratch.shadows.group + scratch.shadows.size, gather(context.scene->groups.of_light, light), bits(step.connects));
            }
            if constexpr (S.has(Feature::links))
                if (context.scene->links.lit_sets)
                    compress(scratch.shadows.mask + scratch.shadows.size, step.shadow_mask, bits(step.connects));
            append<F>(scratch.shadows, step, path.slot, step.connects);
        }
        if constexpr (S.has(Feature::links)) compress(next.part + next.size, step.next.part, bits(step.continues));
        if constexpr (S.has(Feature::dispersion)) compress(next.dispersed + next.size, step.next.dispersed, bits(step.continues));
        if (any(step.continues)) append<S, F>(next, step.next, step.continues);
    }
}

// Adds the light of all shadow rays that reach their light.
template <class F> void connect_paths(const KernelContext& context, TileScratch& scratch, int bounce) {
    const ShadowQueue& q = scratch.shadows;
    const bool alpha = context.accel->has_alpha();
    const RayArrays rays{q.ox, q.oy, q.oz, q.dx, q.dy, q.dz, q.distance, alpha ? q.random.data : nullptr, other_ray_mask,
                         context.scene->links.lit_sets ? q.mask.data : nullptr};
    context.accel->occluded(rays, q.size, bounce == 0, scratch.blocked);
    for (int k = 0; k < q.size; ++k) {
        if (scratch.blocked[k]) continue;
        const int slot = q.slot[k];
        scratch.r[slot] += double(q.r[k]);
        scratch.g[slot] += double(q.g[k]);
        scratch.b[slot] += double(q.b[k]);
        if (scratch.groups) scratch.groups->add(q.group[k], slot, double(q.r[k]), double(q.g[k]), double(q.b[k]));
    }
}

// What the paths have gathered so far, when everything that took at most `bounce` scatterings is in it: light that was aimed at after one
// scattering less, and light that was found.
inline void record_bounce(TileScratch& scratch, int paths, int bounce) {
    BounceColumns& columns = *scratch.bounces;
    if (bounce >= int(columns.after.size())) return;
    copy_radiance(scratch.r, scratch.g, scratch.b, paths, columns.after[size_t(bounce)]);
    columns.recorded = bounce + 1;
}

template <Features S, class F> void render_tile(const KernelContext& context, const TileJob& job, TileScratch& scratch) {
    generate_paths<S, F>(context, job, scratch);
    if (scratch.bounces) scratch.bounces->recorded = 0;
    const bool reuses = context.settings.reuse.size() > 1;
    if (reuses && !scratch.reuse) scratch.reuse = std::make_unique<ReuseColumns>();
    bool own_is_aside = false;
    PathQueue* now = &scratch.paths[0];
    PathQueue* next = &scratch.paths[1];
    for (int bounce = 0; now->size > 0; ++bounce) {
        if (bounce > longest_path) {
            scratch.truncated_paths += now->size;
            break;
        }
        (bounce > 0 ? scratch.bounce_rays : scratch.camera_rays) += now->size;
        trace_paths<F>(context, scratch, *now, bounce);
        shade_paths<S, F>(context, scratch, *now, *next, bounce);
        if (scratch.bounces) record_bounce(scratch, job.paths(), bounce);
        if (scratch.groups && bounce == 1) scratch.groups->note_direct(job.paths());
        scratch.shadow_rays += scratch.shadows.size;
        if (reuses && bounce == 1) {
            set_own_radiance_aside(*scratch.reuse, scratch, job.paths());
            own_is_aside = true;
        }
        if (scratch.shadows.size > 0) connect_paths<F>(context, scratch, bounce);
        std::swap(now, next);
    }
    if (own_is_aside) share_paths<F>(context, job, scratch);
}

} // namespace blush::inline BLUSH_ISA
