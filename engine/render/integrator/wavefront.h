// Wavefront path tracing of a tile: generate, trace, shade, trace
// shadow rays, and repeat with the surviving paths, compacted in order.
#pragma once

#include "render/integrator/blended_background.h"
#include "render/integrator/estimator.h"
#include "render/integrator/group_sums.h"
#include "render/integrator/manifold/light_vertices.h"
#include "render/integrator/path_queues.h"
#include "render/integrator/path_reuse.h"
#include "render/integrator/path_splitting.h"
#include "render/integrator/strategy_sums.h"
#include "render/integrator/thin_transmission.h"
#include "render/kernels/kernel.h"
#include "render/kernels/stage_timer.h"

#include <algorithm>
#include <utility>

namespace blush::inline BLUSH_ISA {

// For the lanes of `straight`; other paths have stored the first pane that they passed.
template <class F> void store_first_hit(FirstHitColumns& c, int k, FirstHit<F> first, const Mask<F>& straight) {
    // At bounce 0 there is no compaction: the k-th path is slot k.
    if (!all(straight)) {
        const auto keep = [&](F& value, const float* column) { value = select(straight, value, load<F>(column + k)); };
        keep(first.albedo.x, c.albedo_r);
        keep(first.albedo.y, c.albedo_g);
        keep(first.albedo.z, c.albedo_b);
        keep(first.normal.x, c.normal_x);
        keep(first.normal.y, c.normal_y);
        keep(first.normal.z, c.normal_z);
        keep(first.depth, c.depth);
        first.object = select(straight, first.object, load<Int<F>>(c.object + k));
        first.material = select(straight, first.material, load<Int<F>>(c.material + k));
    }
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

// Adds light that rays have met.
template <class F> void add_light(TileScratch& scratch, const int32_t* slots, const Vec<F>& radiance, const Mask<F>& lanes) {
    if (scratch.strategies) add_hits_by_strategy<F>(*scratch.strategies, slots, radiance, lanes);
    for_each_lane(bits(lanes), [&](int i) {
        const int slot = slots[i];
        scratch.r[slot] += double(lane(radiance.x, i));
        scratch.g[slot] += double(lane(radiance.y, i));
        scratch.b[slot] += double(lane(radiance.z, i));
    });
}

// Adds the light that the rays of paths k, k + 1, ... found. Light of the background is dimmed by blended surfaces.
template <Features S, class F> [[gnu::always_inline]] inline void add_emission(const KernelContext& context, TileScratch& scratch,
                                                                               const int32_t* slots, int k, const Path<F>& path, int bounce,
                                                                               const Mask<F>& active, Step<F>& step) {
    if constexpr (S.has(Feature::environment) || S.has(Feature::suns)) {
        const SeenBackground<F> background = seen_background<F>(*context.scene, scratch, k, active);
        if (sees_past_blended(*context.scene)) {
            step.emitted = select<F>(background.seen && !background.stopped, step.emitted * background.share, step.emitted);
            add_light<F>(scratch, slots, light_past_blended<S, F>(context, path, bounce, background), background.stopped);
        }
        if (scratch.groups && any(background.seen))
            add_background_by_group<S, F>(context, *scratch.groups, path, bounce, background.share, background.seen);
    }
    if (!any(step.emits)) return;
    add_light<F>(scratch, slots, step.emitted, step.emits);
    if (scratch.groups) add_emission_by_group<F>(context, *scratch.groups, scratch.hits, k, path, step);
}

template <class F> void note_roulette(RouletteColumns& c, const int32_t* slots, const Step<F>& step, const Mask<F>& active, int bounce) {
    const Mask<F> rr_applied = step.weights.rr_applied;
    for_each_lane(bits(active), [&](int i) { c.length[slots[i]] += 1; });
    for_each_lane(bits(rr_applied), [&](int i) {
        c.num_rr_applied[slots[i]] += 1;
        c.survival[slots[i]] += lane(step.weights.survival, i);
    });
    PathCounts& counts = c.counts[std::min(bounce, max_counted_bounces - 1)];
    counts.alive += count(active);
    counts.rr_applied += count(rr_applied);
    counts.survived += count(rr_applied && (step.continues || step.non_finite));
}

// Where begin_paths() finds the pixel and the sample of each slot: columns that are free before the first rays.
struct SampleColumns {
    float *x, *y;
    uint32_t* sample;
};
inline SampleColumns sample_columns(TileScratch& scratch) { return {scratch.hits.t, scratch.hits.u, scratch.random}; }

// Camera rays of the first n slots, whose samples are in sample_columns().
template <Features S, class F> [[gnu::always_inline]] inline void begin_paths(const KernelContext& context, int n, TileScratch& scratch) {
    PathQueue& q = scratch.paths[0];
    const auto [xs, ys, samples] = sample_columns(scratch);
    const uint32_t half[2] = {randomisation(context.seed, 0), randomisation(context.seed, 1)};
    q.size = 0;
    if (!context.scene->adjoint.empty() && !scratch.importance) scratch.importance = std::make_unique<Column<float>>();
    for (int k = 0; k < n; k += width<F>) {
        const F x = load<F>(xs + k), y = load<F>(ys + k);
        const UInt<F> sample = load<UInt<F>>(samples + k);
        const UInt<F> odd = sample & 1u;
        const UInt<F> random = select(as_mask(odd != 0u), UInt<F>(half[1]), UInt<F>(half[0]));
        const UInt<F> column = to_unsigned(to_int(x)), row = to_unsigned(to_int(y)), index = sample >> 1;
        const Sampler<F> sampler = context.settings.sampler == SamplerType::random ? independent_sampler<F>(column, row, random, index)
                                                                                   : pixel_sampler<F>(column, row, random, index);
        const Int<F> slot = iota<F>() + k;
        const Path<F> path = begin_path<S, F>(*context.scene, context.settings, x, y, sampler, slot);
        if (!context.scene->adjoint.empty()) store(scratch.importance->data + k, path.importance);
        if constexpr (S.has(Feature::links)) store(q.part + q.size, Int<F>(from_camera));
        if constexpr (S.has(Feature::dispersion)) store(q.dispersed + q.size, Int<F>(0));
        append<S, F>(q, path, as_mask(slot < n));
    }
    if (scratch.photons) emit_photons(*scratch.photons, q);
    std::fill_n(scratch.r.data, n, 0.0);
    std::fill_n(scratch.g.data, n, 0.0);
    std::fill_n(scratch.b.data, n, 0.0);
    if (scratch.continuations) scratch.continuations->begin(n);
    if (scratch.arrivals) scratch.arrivals->begin(n);
    if (scratch.groups) scratch.groups->clear(n);
    if (scratch.strategies) scratch.strategies->clear(n);
    if (!scratch.roulette) return;
    std::fill_n(scratch.roulette->length.data, n, 0.f);
    std::fill_n(scratch.roulette->num_rr_applied.data, n, 0.f);
    std::fill_n(scratch.roulette->survival.data, n, 0.f);
}

template <Features S, class F>
[[gnu::flatten]] void generate_paths(const KernelContext& context, const TileJob& job, TileScratch& scratch) {
    const SampleColumns to = sample_columns(scratch);
    int n = 0;
    for (int y = 0; y < job.height; ++y)
        for (int x = 0; x < job.width; ++x)
            for (int s = 0; s < job.samples; ++s, ++n) {
                to.x[n] = float(job.x + x);
                to.y[n] = float(job.y + y);
                to.sample[n] = uint32_t(job.sample(s));
            }
    begin_paths<S, F>(context, n, scratch);
}

// Traces the path rays of `now`. In scenes with panes, overwrites `rest` and changes the throughput of paths that pass panes.
template <Features S, class F>
void trace_paths(const KernelContext& context, TileScratch& scratch, PathQueue& now, PathQueue& rest, int bounce) {
    const bool sees_past = sees_past_blended(*context.scene);
    if (sees_past && !scratch.background_share) scratch.background_share = std::make_unique<Column<float>>();
    const PathRays rays = camera_path_rays(bounce);
    trace_rays<F>(context, scratch.random, now, rays, scratch.hits, sees_past ? scratch.background_share->data : nullptr);
    if constexpr (S.has(Feature::transmission))
        if (context.scene->panes) trace_through_panes<S, F>(context, scratch, now, rest, rays);
}

// Returns the ticks spent on sampling lights, which are a part of its own.
template <Features S, class F> [[gnu::flatten]] int64_t shade_paths(const KernelContext& context, TileScratch& scratch,
                                                                    const PathQueue& now, PathQueue& next, int bounce) {
    next.size = 0;
    scratch.shadows.size = 0;
    if (scratch.light_vertices) scratch.light_vertices->connections.size = 0;
    if (samples_manifolds<S>(*context.scene) && !scratch.manifolds) scratch.manifolds = std::make_unique<ManifoldColumns>();
    const bool blends = context.scene->blends;
    SampledTimer light_timer;
    for (int k = 0; k < now.size; k += width<F>) {
        Path<F> path = load_path<S, F>(now, k);
        if constexpr (S.has(Feature::links)) path.part = load<Int<F>>(now.part + k);
        if constexpr (S.has(Feature::dispersion)) path.dispersed = load<Int<F>>(now.dispersed + k);
        const Mask<F> active = as_mask(iota<F>() + k < now.size);
        load_importance<F>(scratch, *context.scene, path, active);
        Step<F> step =
            scatter<S, F>(*context.scene, context.settings, path, load_hit<F>(scratch.hits, k), bounce, active, light_timer.next());
        if (context.settings.emission_only) {
            step.connects = Mask<F>(false);
            step.continues = step.continues && step.next.pdf == F(infinity);
        }
        Mask<F> straight = Mask<F>(true); // the path's ray passed no pane
        if constexpr (S.has(Feature::transmission))
            if (context.scene->panes) straight = as_mask(load<Int<F>>(scratch.panes->passed + k) == 0);
        if (bounce == 0 && scratch.first) store_first_hit<F>(*scratch.first, k, step.first, straight);
        if (bounce <= 1 && context.settings.reuse.size() > 1) {
            // Path reuse connections do not pass panes, so a segment that does is not shared.
            ReuseVertex<F> reuse_vertex = step.reuse_vertex;
            if (bounce == 1) reuse_vertex.lambertian = reuse_vertex.lambertian && straight;
            store_reuse_vertex<F>(*scratch.reuse, now, k, bounce, reuse_vertex);
        }
        if (scratch.roulette) note_roulette<F>(*scratch.roulette, now.slot + k, step, active, bounce);
        if constexpr (S.has(Feature::light_paths))
            if (samples_manifolds<S>(*context.scene)) {
                ManifoldHitColumns& hits = scratch.manifolds->hits;
                take_chain_hits<S, F>(*context.scene, hits, path, load_hit<F>(scratch.hits, k), bounce,
                                      seen_background<F>(*context.scene, scratch, k, active), active, step);
                note_chain_starts<S, F>(context, hits.starts, path, load_hit<F>(scratch.hits, k), step);
            }
        add_emission<S, F>(context, scratch, now.slot + k, k, path, bounce, active, step);
        if (any(step.non_finite)) add_light<F>(scratch, now.slot + k, step.next.beta, step.non_finite);
        if (any(step.connects)) {
            if (blends)
                compress(scratch.shadows.random + scratch.shadows.size, opacity_random<F>(path.key, path.index, uint32_t(2 * bounce + 1)),
                         bits(step.connects));
            if (scratch.groups) {
                const Int<F> light = select(step.connects, step.light, Int<F>(0));
                compress(scratch.shadows.group + scratch.shadows.size, gather(context.scene->groups.of_light, light), bits(step.connects));
            }
            if constexpr (S.has(Feature::links))
                if (context.scene->links.lit_sets)
                    compress(scratch.shadows.mask + scratch.shadows.size, step.shadow_mask, bits(step.connects));
            if (scratch.trials) record_trials<F>(scratch, step, step.connects);
            append<F>(scratch.shadows, step, path.slot, step.connects);
        }
        if constexpr (S.has(Feature::light_paths))
            if (samples_manifolds<S>(*context.scene)) {
                add_receivers<S, F>(context, scratch, path, load_hit<F>(scratch.hits, k), step, bounce, active);
                if (connects_light_vertices<S>(*context.scene))
                    queue_connections<S, F>(context, *scratch.light_vertices, path, step, bounce, active);
            }
        if constexpr (S.has(Feature::links)) compress(next.part + next.size, step.next.part, bits(step.continues));
        if constexpr (S.has(Feature::dispersion)) compress(next.dispersed + next.size, step.next.dispersed, bits(step.continues));
        if (scratch.strategies) note_guided<F>(*scratch.strategies, now.slot + k, step);
        if (scratch.escapes) record_escapes<F>(*scratch.escapes, step.next, step.continues);
        if (scratch.guiding) record_guiding<F>(*scratch.guiding, step.next, step.continues);
        if (scratch.arrivals) record_arrivals<F>(*scratch.arrivals, path, load_hit<F>(scratch.hits, k), active);
        if (scratch.continuations) record_continuations<F>(*scratch.continuations, path, step.next, step.continues, active);
        if (scratch.photons) record_photons<F>(context.scene->lights, *scratch.photons, path, step, bounce, step.continues);
        if (any(step.continues)) append<S, F>(next, step.next, step.continues);
    }
    return light_timer.estimate();
}

// Adds the light of all unoccluded shadow rays.
template <Features S, class F> void connect_paths(const KernelContext& context, TileScratch& scratch, int bounce) {
    connect_rays<S, F>(context, scratch, Connects::to_lights, bounce == 0, [&](int k) { add_shadow_light(scratch, scratch.shadows, k); });
}

// Adds the light of chains at the vertices of a bounce. Overwrites `rays`.
template <Features S, class F> void add_chains(const KernelContext& context, TileScratch& scratch, PathQueue& rays, int bounce) {
    sample_manifolds<S, F>(context, scratch, rays, bounce);
    if (connects_light_vertices<S>(*context.scene)) add_connections<F>(context, scratch, bounce);
}

// Stores the radiance so far as the result after at most `bounce` scatterings: emission at hits, and NEE of one scattering less.
inline void record_bounce(TileScratch& scratch, int paths, int bounce) {
    BounceColumns& columns = *scratch.bounces;
    if (bounce >= int(columns.after.size())) return;
    copy_radiance(scratch.r, scratch.g, scratch.b, paths, columns.after[size_t(bounce)]);
    columns.recorded = bounce + 1;
}

template <Features S, class F> void render_tile(const KernelContext& context, const TileJob& job, TileScratch& scratch) {
    StageTimer timer(scratch.stages);
    generate_paths<S, F>(context, job, scratch);
    timer.end(Stage::generate);
    if (scratch.bounces) scratch.bounces->begin();
    if constexpr (S.has(Feature::light_paths))
        if (connects_light_vertices<S>(*context.scene)) trace_light_vertices<S, F>(context, scratch);
    const bool reuses = context.settings.reuse.size() > 1;
    if (reuses && !scratch.reuse) scratch.reuse = std::make_unique<ReuseColumns>();
    // Path reuse shares one second vertex of each sample.
    const bool splits = context.scene->adjoint.splits && !reuses;
    bool unshared_is_stashed = false;
    const auto radiance_of = [&](int slot) { return dot(luminance_weights, Vec3d{scratch.r[slot], scratch.g[slot], scratch.b[slot]}); };
    PathQueue* now = &scratch.paths[0];
    PathQueue* next = &scratch.paths[1];
    for (int bounce = 0; now->size > 0; ++bounce) {
        if (bounce > max_path_length) {
            scratch.truncated_paths += now->size;
            break;
        }
        (bounce > 0 ? scratch.bounce_rays : scratch.camera_rays) += now->size;
        trace_paths<S, F>(context, scratch, *now, *next, bounce);
        if (scratch.escapes) {
            if (bounce > 0) scratch.escapes->note_hits(scratch.hits.geometry, now->size);
            scratch.escapes->first = scratch.escapes->all.size();
        }
        timer.end(Stage::trace);
        if (splits && bounce < context.settings.max_bounces) split_paths<S, F>(context, scratch, *now, bounce);
        const int64_t light_ticks = shade_paths<S, F>(context, scratch, *now, *next, bounce);
        scratch.stages[Stage::light] += light_ticks;
        if (scratch.bounces) record_bounce(scratch, job.paths(), bounce);
        if (bounce == 1 && (scratch.groups || scratch.strategies)) note_direct_light(scratch, job.paths());
        scratch.shadow_rays += scratch.shadows.size;
        if (reuses && bounce == 1) {
            stash_unshared_radiance(*scratch.reuse, scratch, job.paths());
            unshared_is_stashed = true;
        }
        timer.end(Stage::shade, light_ticks);
        if (scratch.arrivals) scratch.arrivals->note_arrived(radiance_of);
        if (scratch.shadows.size > 0) connect_paths<S, F>(context, scratch, bounce);
        if constexpr (S.has(Feature::light_paths))
            if (samples_manifolds<S>(*context.scene)) add_chains<S, F>(context, scratch, *now, bounce);
        timer.end(Stage::shadow);
        if (scratch.strategies) scratch.strategies->next_bounce();
        if (scratch.guiding) scratch.guiding->note_arrived(radiance_of);
        if (scratch.continuations) scratch.continuations->note_arrived(radiance_of);
        std::swap(now, next);
    }
    if constexpr (S.has(Feature::light_paths))
        if (scratch.bounces) finish_chained_light(scratch, job.paths());
    if (scratch.guiding) scratch.guiding->finish(radiance_of);
    if (scratch.continuations) scratch.continuations->finish(radiance_of);
    if (scratch.arrivals) scratch.arrivals->finish(radiance_of);
    if (!unshared_is_stashed) return;
    reuse_paths<F>(context, job, scratch);
    timer.end(Stage::reuse);
}

} // namespace blush::inline BLUSH_ISA
