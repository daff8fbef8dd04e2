// Splitting: where a path is worth much, it goes on in several copies with equal shares of its throughput, which sample their lights and
// directions independently. The ray to their common vertex is traced once. Arvo and Kirk 1990, "Particle Transport and Image Synthesis";
// the number of copies: Rath et al. 2022, rounded, as stochastic rounding would add noise.
#pragma once

#include "render/integrator/blended_background.h"
#include "render/integrator/path_queues.h"

#include <algorithm>
#include <memory>

namespace blush::inline BLUSH_ISA {

constexpr uint32_t splitting_key = 0x5b1e7c3d; // any: tells the random numbers of copies from others

// Makes path `to` of the queue, whose ray has been traced, equal to path `from`.
template <Features S> void copy_path(TileScratch& scratch, PathQueue& q, int from, int to) {
    const auto copy = [&](auto&... columns) { ((columns[to] = columns[from]), ...); };
    copy(q.ox, q.oy, q.oz, q.dx, q.dy, q.dz, q.beta_r, q.beta_g, q.beta_b, q.pdf, q.key, q.index, q.slot);
    if constexpr (S.has(Feature::light_tree)) copy(q.nx, q.ny, q.nz);
    if constexpr (S.has(Feature::textures)) copy(q.cone);
    if constexpr (S.has(Feature::light_paths)) copy(q.light_ratio, q.emission_ratio, q.chain);
    if constexpr (S.has(Feature::links)) copy(q.part);
    if constexpr (S.has(Feature::dispersion)) copy(q.dispersed);
    HitColumns& h = scratch.hits;
    copy(h.t, h.u, h.v, h.geometry, h.instance, h.triangle);
    if (scratch.panes) copy(scratch.panes->passed);
    if (scratch.background_share) copy(*scratch.background_share);
}

// The number of copies that each path of the queue is worth, before limits. Paths that scatter no more, and those of a single wavelength,
// which belongs to their random numbers, are worth one.
template <Features S, class F>
void count_copies(const KernelContext& context, const TileScratch& scratch, const PathQueue& q, Column<int32_t>& copies) {
    const SceneTables& scene = *context.scene;
    for (int k = 0; k < q.size; k += width<F>) {
        Path<F> path = load_path<S, F>(q, k);
        const Hit<F> hit = load_hit<F>(scratch.hits, k);
        const Mask<F> active = as_mask(iota<F>() + k < q.size);
        Mask<F> scatters = active && as_mask(hit.geometry >= 0) && !as_mask(hit.instance == sphere_instance);
        if constexpr (S.has(Feature::dispersion)) scatters = scatters && as_mask(load<Int<F>>(q.dispersed + k) == 0);
        load_importance<F>(scratch, scene, path, active);
        const F worth = luminance(path.beta) * path.importance *
                        adjoint_split<F>(scene.adjoint, path.ray.origin + path.ray.direction * hit.t, -path.ray.direction);
        // The order of min and max maps NaN to 1.
        store(copies + k, to_int(select(scatters, min(max(worth + 0.5f, F(1.f)), F(float(most_copies))), F(1.f))));
    }
}

// Splits the paths whose rays were traced. Copies follow at the end of the queue. No sample has more than most_copies paths. The tile must
// have room for so many of each (tile_shape.h); a path that finds none is not split, so nothing is written past the columns.
template <Features S, class F>
[[gnu::noinline]] void split_paths(const KernelContext& context, TileScratch& scratch, PathQueue& q, int bounce) {
    if (!scratch.splitting) scratch.splitting = std::make_unique<SplittingColumns>();
    Column<int32_t>&alive = scratch.splitting->alive, &copies = scratch.splitting->copies;
    const int paths = q.size;
    for (int k = 0; k < paths; ++k) alive[q.slot[k]] = 0;
    for (int k = 0; k < paths; ++k) ++alive[q.slot[k]];
    count_copies<S, F>(context, scratch, q, copies);
    for (int k = 0; k < paths; ++k) {
        const int n = std::min(copies[k], most_copies / alive[q.slot[k]]);
        if (n < 2 || q.size + n > tile_capacity) continue;
        const float share = 1 / float(n);
        for (Column<float>* beta : {&q.beta_r, &q.beta_g, &q.beta_b}) (*beta)[k] *= share;
        for (int j = 1; j < n; ++j) {
            copy_path<S>(scratch, q, k, q.size);
            q.key[q.size++] ^= pcg_hash(uint32_t(bounce * most_copies + j) ^ splitting_key);
        }
    }
}

} // namespace blush::inline BLUSH_ISA
