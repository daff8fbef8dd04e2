// Light of paths by the strategy that has found it (kernels/strategy_columns.h). Not inlined: few images ask for it.
#pragma once

#include "render/integrator/path.h"
#include "render/kernels/kernel.h"

namespace blush::inline BLUSH_ISA {

// Adds light that rays have met.
template <class F> [[gnu::noinline, gnu::flatten]] void add_hits_by_strategy(StrategyColumns& strategies, const int32_t* slots,
                                                                             const Vec<F>& radiance, const Mask<F>& lanes) {
    for_each_lane(bits(lanes), [&](int i) {
        strategies.add_hit(slots[i], double(lane(radiance.x, i)), double(lane(radiance.y, i)), double(lane(radiance.z, i)));
    });
}
[[gnu::noinline, gnu::flatten]] inline void add_hit_by_strategy(StrategyColumns& strategies, int slot, double r, double g, double b) {
    strategies.add_hit(slot, r, g, b);
}

// Adds light that no ray of the path has met.
[[gnu::noinline, gnu::flatten]] inline void add_by_strategy(StrategyColumns& strategies, FoundBy by, int slot, double r, double g,
                                                            double b) {
    strategies.light.add(int(by), slot, r, g, b);
}

// Notes the share of path guiding in the next directions. A delta lobe keeps that of the direction before.
template <class F>
[[gnu::noinline, gnu::flatten]] void note_guided(StrategyColumns& strategies, const int32_t* slots, const Step<F>& step) {
    const float* before = strategies.guided[strategies.now];
    float* next = strategies.guided[1 - strategies.now];
    for_each_lane(bits(step.continues), [&](int i) {
        const int slot = slots[i];
        next[slot] = lane(step.next.pdf, i) == infinity ? before[slot] : lane(step.weights.guided, i);
    });
}

// Keeps light of at most one scattering, by group and by strategy, for clamping.
[[gnu::noinline, gnu::flatten]] inline void note_direct_light(TileScratch& scratch, int paths) {
    if (scratch.groups) scratch.groups->note_direct(paths);
    if (scratch.strategies) scratch.strategies->light.note_direct(paths);
}

// Light of manifold sampling, of a path that scatters so often (BounceColumns::chained).
[[gnu::noinline, gnu::flatten]] inline void add_chained_light(BounceColumns& bounces, int scatterings, int slot, double r, double g,
                                                              double b) {
    if (!bounces.has_chained)
        for (RadianceColumns& column : bounces.chained) column.clear(tile_capacity);
    bounces.has_chained = true;
    RadianceColumns& c = bounces.chained[size_t(std::min(scatterings, int(bounces.after.size())))];
    c.r[slot] += r;
    c.g[slot] += g;
    c.b[slot] += b;
}
// Adds it to all columns from its own one on, and to the radiance of the paths, which have ended.
[[gnu::noinline, gnu::flatten]] inline void finish_chained_light(TileScratch& scratch, int paths) {
    BounceColumns& bounces = *scratch.bounces;
    if (!bounces.has_chained) return;
    const int columns = int(bounces.after.size());
    for (; bounces.recorded < columns; ++bounces.recorded)
        copy_radiance(scratch.r, scratch.g, scratch.b, paths, bounces.after[size_t(bounces.recorded)]);
    const auto add = [&](double* to, const double* from) {
        for (int i = 0; i < paths; ++i) to[i] += from[i];
    };
    for (int k = 0; k <= columns; ++k) {
        RadianceColumns& light = bounces.chained[size_t(k)];
        if (k > 0) {
            const RadianceColumns& before = bounces.chained[size_t(k - 1)];
            add(light.r, before.r);
            add(light.g, before.g);
            add(light.b, before.b);
        }
        add(k < columns ? bounces.after[size_t(k)].r : scratch.r, light.r);
        add(k < columns ? bounces.after[size_t(k)].g : scratch.g, light.g);
        add(k < columns ? bounces.after[size_t(k)].b : scratch.b, light.b);
    }
}

} // namespace blush::inline BLUSH_ISA
