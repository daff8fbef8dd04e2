// Renders samples, tile by tile.
#include "render/diagnostics/fault_finder.h"
#include "render/integrator/kernel_settings.h"
#include "render/integrator/reuse_groups.h"
#include "render/kernels/stage_timer.h"
#include "render/pilots/edges/edge_pilot.h"
#include "render/pilots/edges/highlight_pilot.h"
#include "render/renderer_state.h"

#include <algorithm>
#include <atomic>
#include <tuple>
#include <utility>

namespace blush {

KernelContext Renderer::State::context_for(const SceneTables& tables, int width, int height) const {
    KernelContext context{&tables, &scene.accel(), kernel_settings(settings, width, height)};
    context.settings.filter_textures = options.filter_textures;
    return context;
}

bool Renderer::State::render_run(TileJob job, const Run& run, int max_samples, unsigned worker, const Wanted& wanted) {
    const SceneTables tables = tables_for(run.first);
    KernelContext context = context_for(tables, film.width(), film.height());
    context.seed = settings.seed;
    context.settings.reuse = run.groups;
    TileScratch& tile = scratch_of(worker);
    const Film::Diagnose diagnose = [&](int x, int y, int64_t sample) {
        if (!replays[worker]) replays[worker] = std::make_unique<TileScratch>();
        return find_fault(context, x, y, sample, *replays[worker]);
    };
    const EdgePixels* pixels = divider == 1 ? edges.pixels(run.first) : nullptr;
    job.stride = run.stride;
    if (tables.adjoint.splits) max_samples = std::clamp(tile_capacity / (most_copies * job.width * job.height), 1, max_samples);
    for (int64_t done = 0; done < run.count; done += job.samples) {
        if (done > 0 && wanted && !wanted()) return false;
        job.first_sample = run.first + done * run.stride;
        job.samples = int(std::min<int64_t>(max_samples, run.count - done));
        kernel_for(tables).render(context, job, tile);
        if (replacement) add_replacement(job, tile, worker);
        if (pixels) refine_emission(context, *kernel, *pixels, job, tile, edge_scratch_of(worker));
        StageTimer timer(tile.stages);
        const CatcherColumns* shadows = shadows_of(context, job, worker);
        timer.end(Stage::shadow);
        film.add(job, tile, settings.seed, diagnose, shadows);
        timer.end(Stage::film);
    }
    return true;
}

// For the tile's samples; null without a shadow catcher.
const CatcherColumns* Renderer::State::shadows_of(const KernelContext& context, const TileJob& job, unsigned worker) {
    if (!catches()) return nullptr;
    if (!catching[worker]) catching[worker] = std::make_unique<CatcherScratch>();
    catch_shadows(context, scene.catchers(), job, *catching[worker]);
    return &catching[worker]->columns;
}

// The rendered part of the film. Path reuse needs whole groups.
PixelRect Renderer::State::rendered_pixels() const {
    PixelRect r = pixels_of(settings.region, film.width(), film.height());
    if (learned.reuse().first_group_size() <= 1) return r;
    const ReuseGroups groups = reuse_groups(learned.reuse().first_group_size());
    const auto down = [](int x, int block) { return x / block * block; };
    const auto up = [](int x, int block) { return (x + block - 1) / block * block; };
    return {down(r.x0, groups.block_width), down(r.y0, groups.block_height), std::min(up(r.x1, groups.block_width), film.width()),
            std::min(up(r.y1, groups.block_height), film.height())};
}

// Adds what the workers have counted.
void Renderer::State::collect_counts(const TickRate& rate) {
    for (const auto& used : catching)
        if (used) rays.shadow += std::exchange(used->tile.shadow_rays, 0);
    for (const auto& used : scratch) {
        if (!used) continue;
        const StageTicks spent = std::exchange(used->stages, {});
        add_seconds(stages, spent, rate.seconds_per_tick());
        rays.bounce += std::exchange(used->bounce_rays, 0);
        rays.shadow += std::exchange(used->shadow_rays, 0);
        rays.camera += std::exchange(used->camera_rays, 0);
        truncated += std::exchange(used->truncated_paths, 0);
        if (used->roulette) move_counts(used->roulette->counts, path_counts);
    }
}

bool Renderer::State::for_each_tile(const TileShape& shape, const Wanted& wanted, const TileTask& task) {
    const int across = (film.width() + shape.width - 1) / shape.width, down = (film.height() + shape.height - 1) / shape.height;
    const PixelRect wanted_pixels = rendered_pixels();
    const TickRate rate;
    std::atomic<bool> cut_short{false};
    const bool all_begun = workers.for_each(int64_t(across) * down, wanted, [&](int64_t tile, unsigned worker) {
        const int x = int(tile % across) * shape.width, y = int(tile / across) * shape.height;
        TileJob job;
        job.x = std::max(x, wanted_pixels.x0);
        job.y = std::max(y, wanted_pixels.y0);
        job.width = std::min(x + shape.width, wanted_pixels.x1) - job.x;
        job.height = std::min(y + shape.height, wanted_pixels.y1) - job.y;
        if (job.width <= 0 || job.height <= 0) return;
        if (!task(int(tile), job, worker)) cut_short = true;
    });
    collect_counts(rate);
    return all_begun && !cut_short;
}

// Renders the same samples for every pixel; path reuse is the same for all of them.
bool Renderer::State::render_uniformly(int64_t first, int64_t count, const Wanted& wanted) {
    const PixelRect pixels = rendered_pixels();
    const ReuseGroups groups = reuse_groups(reuse_group_size(first));
    const int64_t pixels_per_worker = int64_t(pixels.x1 - pixels.x0) * (pixels.y1 - pixels.y0) / workers.threads();
    const bool splits = tables_for(first).adjoint.splits;
    const TileShape shape = groups.size() > 1 ? tile_shape(groups) : splits ? splitting_shape(count) : tile_shape(count, pixels_per_worker);
    return for_each_tile(shape, wanted, [&](int, const TileJob& job, unsigned worker) {
        return render_run(job, {first, count, 1, groups}, shape.samples, worker, wanted);
    });
}

// Renders the samples of each half of each tile by the sample plan.
bool Renderer::State::render_by_plan(int64_t first, int64_t count, const Wanted& wanted) {
    constexpr TileShape shape{SampleAllocation::tile_size, SampleAllocation::tile_size, 8};
    const ReuseGroups groups = reuse_groups_of_plan(reuse_group_size(first));
    return for_each_tile(shape, wanted, [&](int tile, const TileJob& job, unsigned worker) {
        for (int half = 0; half < 2; ++half) {
            const int64_t from = sample_allocation.samples(tile, half, first), to = sample_allocation.samples(tile, half, first + count);
            if (!render_run(job, {2 * from + half, to - from, 2, groups}, shape.samples, worker, wanted)) return false;
        }
        return true;
    });
}

// Smooth edges for the first sample, once the pilot has found them. A film without other samples stays as it is.
bool Renderer::State::refine_first_sample(const Wanted& wanted) {
    if (!std::exchange(first_is_rough, false)) return true;
    const EdgePixels* pixels = edges.pixels(1);
    if (!pixels) return true;
    const SceneTables rendered_with = tables_for(0);
    KernelContext context = context_for(rendered_with, film.width(), film.height());
    context.seed = settings.seed;
    SceneTables tables;
    restrict_to_emission(context, tables, pixels->longest_chain());
    constexpr TileShape shape{32, 32, 1};
    const bool all = for_each_tile(shape, wanted, [&](int, const TileJob& job, unsigned worker) {
        if (!pixels->any(job.x, job.y, job.width, job.height)) return true;
        TileScratch& tile = scratch_of(worker);
        const auto counted = std::pair(tile.camera_rays, tile.bounce_rays); // these are no paths
        kernel->render(context, job, tile);
        std::tie(tile.camera_rays, tile.bounce_rays) = counted;
        film.add_to_first_sample(job, tile, *pixels, -1);
        refine_emission(context, *kernel, *pixels, job, tile, edge_scratch_of(worker));
        film.add_to_first_sample(job, tile, *pixels, 1);
        return true;
    });
    return all || !(film_is_uneven = true);
}

// Adds the light paths and the smooth edges that the first sample lacks.
bool Renderer::State::complete_first_sample(const Wanted& wanted) { return complete_first_pass(wanted) && refine_first_sample(wanted); }

// Renders the first sample again, as the pilots decided for the others.
bool Renderer::State::renew_first_sample(const Wanted& wanted) {
    splats = learned.light_paths().pays();
    early_splats = false;
    first_as_others = true;
    return render_first_again(wanted);
}

// Discards the film's only sample.
bool Renderer::State::render_first_again(const Wanted& wanted) {
    film_is_stale = true;
    clear_stale_film();
    rays = {};
    path_counts.clear();
    truncated = 0;
    first_is_trained = false;
    first_pass_tiles = 0;
    return (render_uniformly(0, 1, wanted) && trace_light_paths(0, 1, wanted)) || !(film_is_uneven = true);
}

// Light paths for the film's only sample, which stays as it is.
bool Renderer::State::add_first_pass(const Wanted& wanted) {
    splats = true;
    early_splats = false;
    film.begin_light_paths(divided_film());
    feature_report.reset();
    return trace_light_paths(0, 1, wanted) || !(film_is_uneven = true);
}

bool Renderer::settle_first_sample(const std::function<bool()>& wanted) {
    State& s = *state_;
    if (s.first_is_incomplete() && !(s.decide_edges(wanted) && s.complete_first_sample(wanted))) return false;
    if (!s.first_is_trained) return true;
    s.learned.drop_kept();
    s.kernel_name = State::name_of(*s.kernel);
    s.info.reset();
    s.feature_report.reset();
    s.begin_early_splats(true);
    return s.render_first_again(wanted);
}

bool Renderer::begins_with_seeds() const { return state_->learned.kept_seeds() != nullptr; }

bool Renderer::State::learn(int64_t samples, const Wanted& wanted) {
    if (!learned.needs_pilot(samples)) return true;
    const SceneTables tables = scene.tables();
    if (!learned.decide(samples, context_for(tables, settings.width, settings.height), *kernel, workers, replays, wanted)) return false;
    kernel_name = name_of(kernel_for(learned.tables(tables, 1)));
    info.reset();
    feature_report.reset();
    return true;
}

bool Renderer::State::decide_edges(const Wanted& wanted) {
    if (!edges.needs_pilot() && !needs_highlights()) return true;
    const SceneTables tables = learned.tables(scene.tables(), 1);
    if (!find_edges_and_highlights(context_for(tables, settings.width, settings.height), wanted)) return false;
    info.reset();
    feature_report.reset();
    return true;
}

// Each pilot measures the samples as those before it have decided.
bool Renderer::State::decide(int64_t samples, const Wanted& wanted) { return learn(samples, wanted) && decide_edges(wanted); }

bool Renderer::State::needs_highlights() const { return !highlights && scene.may_have_highlights(); }

bool Renderer::State::find_edges_and_highlights(const KernelContext& context, const Wanted& wanted) {
    std::optional<Sightings> sightings = Sightings{};
    if (needs_highlights() || (edges.needs_pilot() && edges.longest_chain() > 0))
        sightings = find_small_highlights(context, *kernel, workers, replays, wanted);
    if (!sightings) return false;
    if (!edges.needs_pilot() || edges.longest_chain() == 0) {
        if (needs_highlights()) highlights = highlights_of(*sightings);
        sightings = Sightings{};
    }
    if (!edges.needs_pilot()) return true;
    auto found = find_edge_pixels(context, {kernel_for(*context.scene), *kernel}, learned.light_paths().work_per_sample(),
                                  edges.longest_chain(), *sightings, workers, replays, wanted);
    if (!found) return false;
    edges.decide(std::move(found->pixels));
    if (needs_highlights()) highlights = found->highlights;
    return true;
}

bool Renderer::decide(const std::function<bool()>& wanted, int64_t samples) { return state_->decide(samples, wanted); }
bool Renderer::decide_first_sample(const std::function<bool()>& wanted) { return state_->learn(2, wanted); }

bool Renderer::render(int64_t first, int64_t count, const std::function<bool()>& wanted) {
    State& s = *state_;
    const int64_t begin = s.settings.adaptive && !s.options.is_part ? s.loaded_first + s.samples : first;
    const bool begins_others = begin + count > 1 || s.options.is_part;
    if (s.samples == 0) s.begin_early_splats(s.divider > 1 || !(begins_others || s.begins_decided(begin)));
    s.clear_stale_film();
    if (!s.prepare_replacement(wanted)) return false;
    if (s.divider == 1 && (begins_others || s.begins_decided(begin))) {
        if (begins_others && !s.decide(2, wanted)) return false;
        if (s.samples == 0) s.begin_splats();
        if (s.learned.renews_first()) {
            if (begin == 0) s.first_as_others = true;
            if (s.first_is_rough && !s.first_as_others && s.samples == 1 && !s.renew_first_sample(wanted)) return false;
        } else if (s.first_is_trained) {
            s.splats = s.learned.light_paths().pays();
            s.early_splats = false;
            if (!s.render_first_again(wanted)) return false;
        } else if (s.samples == 1 && !s.splats && s.learned.light_paths().alone() && !s.add_first_pass(wanted))
            return false;
    }
    for (int64_t done = 0; done < count;) {
        const int64_t next = begin + done;
        int64_t step = count - done;
        // Ends where the pilot of adaptive sampling is measured, and where what the pilots decided begins.
        if (s.settings.adaptive) step = std::min(step, SampleAllocation::next_measurement(next) - next);
        if (next == 0 && s.first_differs()) step = 1;
        if (s.divider == 1 && next < AdjointChoice::first_sample) step = std::min(step, AdjointChoice::first_sample - next);
        if (s.replacement && s.replacement->prepares_samples()) step = 1;
        if (s.divider == 1 && s.learned.needs_pilot(next + step) && !s.decide(next + step, wanted)) return false;
        if (!s.prepare_replacement_for(next, wanted)) return !(s.film_is_uneven = true);
        if (next > 0 && !s.complete_first_sample(wanted)) return false;
        const bool planned = s.settings.adaptive && next >= SampleAllocation::pilot_samples && s.sample_allocation.decided();
        if (!(planned ? s.render_by_plan(next, step, wanted) : s.render_uniformly(next, step, wanted)) ||
            !(begins_others ? s.trace_light_paths(next, step, wanted) : s.begin_first_pass(wanted)))
            return !(s.film_is_uneven = true);
        if (next == 0) {
            s.first_is_rough = s.divider == 1;
            s.first_is_trained = s.first_is_rough && !s.first_as_others && s.uses_kept();
            if (s.options.is_part && !s.refine_first_sample(wanted)) return false;
        }
        s.samples += step;
        done += step;
        // The pilot is measured in a film that holds it from its first sample.
        if (!s.settings.adaptive || s.sample_allocation.decided() || s.samples != next + step) continue;
        if (s.samples == SampleAllocation::pilot_samples / 2) s.pilot_variance.mark(s.film);
        if (s.samples == SampleAllocation::pilot_samples) s.sample_allocation.decide(s.pilot_variance.measure(s.film));
    }
    return true;
}

} // namespace blush
