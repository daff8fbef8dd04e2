#include "render/film/edges/edge_samples.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace blush {
namespace {

constexpr uint32_t edge_seed = 0x5a1e7d3bu; // any

// As the film checks samples (film.cpp).
bool is_valid(const Vec3d& e) {
    constexpr double largest = double(std::numeric_limits<float>::max());
    return e.x >= 0 && e.y >= 0 && e.z >= 0 && std::max({e.x, e.y, e.z}) <= largest;
}

// Of `count` slots from `slot` on.
template <class Columns> Vec3d mean_of(const Columns& c, int slot, int count) {
    Vec3d sum{0, 0, 0};
    for (int k = slot; k < slot + count; ++k) sum = sum + Vec3d{c.r[k], c.g[k], c.b[k]};
    return sum * (1.0 / count);
}

// The radiance is a sum that contains the old emission, so the difference is negative by rounding only.
template <class Columns> void replace(Columns& c, int slot, const Vec3d& before, const Vec3d& now) {
    c.r[slot] = std::max(0.0, c.r[slot] - before.x) + now.x;
    c.g[slot] = std::max(0.0, c.g[slot] - before.y) + now.y;
    c.b[slot] = std::max(0.0, c.b[slot] - before.z) + now.z;
}

// Gives the emission the planes of the tile.
void fit_planes(const TileScratch& tile, TileScratch& emission) {
    if (!tile.groups)
        emission.groups.reset();
    else if (!emission.groups || emission.groups->count() != tile.groups->count())
        emission.groups = std::make_unique<GroupColumns>(tile.groups->count(), false);
    if (!tile.bounces)
        emission.bounces.reset();
    else if (!emission.bounces || emission.bounces->after.size() != tile.bounces->after.size())
        emission.bounces = std::make_unique<BounceColumns>(int(tile.bounces->after.size()));
}

// Light of at most `bounce` scatterings.
Vec3d mean_after(const TileScratch& emission, int bounce, int slot, int count) {
    if (bounce >= emission.bounces->recorded) return mean_of(emission, slot, count);
    return mean_of(emission.bounces->after[size_t(bounce)], slot, count);
}

// The columns of bounces that no path of the tile has reached: its more samples may.
void record_all_bounces(TileScratch& tile, int paths) {
    BounceColumns& bounces = *tile.bounces;
    for (; bounces.recorded < int(bounces.after.size()); ++bounces.recorded)
        copy_radiance(tile.r, tile.g, tile.b, paths, bounces.after[size_t(bounces.recorded)]);
}

// Slots of emission samples that belong to a sample of the tile.
struct EmissionSlots {
    int own, more, count;
};

void refine_sample(TileScratch& tile, int slot, const EdgeScratch& scratch, const EmissionSlots& at) {
    const TileScratch &own = scratch.own, &more = scratch.more;
    const Vec3d before = mean_of(own, at.own, 1), now = mean_of(more, at.more, at.count);
    if (!is_valid(before) || !is_valid(now)) return;
    replace(tile, slot, before, now);
    if (tile.bounces)
        for (int k = 0; k < tile.bounces->recorded; ++k)
            replace(tile.bounces->after[size_t(k)], slot, mean_after(own, k, at.own, 1), mean_after(more, k, at.more, at.count));
    if (tile.strategies) {
        GroupColumns& light = tile.strategies->light;
        constexpr auto hit = size_t(FoundBy::camera_hit);
        replace(light.all[hit], slot, before, now);
        if (light.has_direct && !light.direct.empty()) replace(light.direct[hit], slot, before, now);
    }
    if (!tile.groups) return;
    for (size_t k = 0; k < tile.groups->all.size(); ++k) {
        const Vec3d group_before = mean_of(own.groups->all[k], at.own, 1), group_now = mean_of(more.groups->all[k], at.more, at.count);
        replace(tile.groups->all[k], slot, group_before, group_now);
        if (tile.groups->has_direct && !tile.groups->direct.empty()) replace(tile.groups->direct[k], slot, group_before, group_now);
    }
}

// Pixels [x, x + width) of a row of a tile, with so many emission samples for each sample.
struct Run {
    int x, y, width, emission_samples;
};
constexpr int most_chains = tile_capacity / most_copies; // that the kernel traces at once

// For its samples `first`, `first` + step, ... of the tile, which are in one half of the film.
void refine_half(const KernelContext& context, const Kernel& kernel, const Run& run, const TileJob& job, int first, int step,
                 TileScratch& tile, EdgeScratch& scratch) {
    const int count = (job.samples - first + step - 1) / step, each = run.emission_samples;
    const int64_t sample = job.sample(first), half = sample & 1;
    KernelContext apart = context;
    apart.seed ^= edge_seed;
    const int at_once = std::max(1, most_chains / (run.width * each));
    for (int done = 0; done < count; done += at_once) {
        const int now = std::min(at_once, count - done);
        const TileJob more{run.x, run.y, run.width, 1, 2 * ((sample >> 1) + done) * each + half, now * each, 2};
        kernel.trace_chains(apart, more, scratch.more);
        for (int x = 0; x < run.width; ++x)
            for (int k = 0; k < now; ++k) {
                const int s = first + (done + k) * step, pixel = (run.y - job.y) * job.width + run.x - job.x + x;
                refine_sample(tile, pixel * job.samples + s, scratch, {x * job.samples + s, (x * now + k) * each, each});
            }
    }
}

void refine_run(const KernelContext& context, const Kernel& kernel, const Run& run, const TileJob& job, TileScratch& tile,
                EdgeScratch& scratch) {
    TileJob own = job;
    own.x = run.x;
    own.y = run.y;
    own.width = run.width;
    own.height = 1;
    kernel.render(context, own, scratch.own);
    const int halves = job.stride % 2 == 0 ? 1 : 2;
    for (int half = 0; half < std::min(halves, job.samples); ++half) refine_half(context, kernel, run, job, half, halves, tile, scratch);
}

} // namespace

void restrict_to_emission(KernelContext& context, SceneTables& tables, int longest_chain) {
    tables = *context.scene;
    tables.emission = {};
    tables.manifolds = {};
    context.scene = &tables;
    context.settings.max_bounces = std::min(context.settings.max_bounces, longest_chain);
    context.settings.emission_only = true;
    context.settings.reuse = {};
}

void refine_emission(KernelContext context, const Kernel& kernel, const EdgePixels& pixels, const TileJob& job, TileScratch& tile,
                     EdgeScratch& scratch) {
    if (!pixels.any(job.x, job.y, job.width, job.height)) return;
    SceneTables tables;
    restrict_to_emission(context, tables, pixels.longest_chain());
    fit_planes(tile, scratch.own);
    fit_planes(tile, scratch.more);
    if (tile.bounces) record_all_bounces(tile, job.paths());
    if (!scratch.more.chains) scratch.more.chains = std::make_unique<ChainColumns>();
    scratch.more.chains->places = pixels.places().empty() ? nullptr : &pixels.places();
    for (int y = job.y; y < job.y + job.height; ++y)
        for (int x = job.x; x < job.x + job.width; ++x) {
            const int begin = x, each = pixels.samples(x, y), longest = each ? std::max(1, most_chains / (job.samples * each)) : 0;
            while (x < job.x + job.width && x - begin < longest && pixels.samples(x, y) == each) ++x;
            if (x > begin) refine_run(context, kernel, {begin, y, x-- - begin, each}, job, tile, scratch);
        }
    for (TileScratch* used : {&scratch.own, &scratch.more}) {
        const StageTicks spent = std::exchange(used->stages, {});
        for (size_t k = 0; k < spent.of.size(); ++k) tile.stages.of[k] += spent.of[k];
    }
}

} // namespace blush
