// Traces light paths for samples of the image, pass by pass.
#include "render/film/splat.h"
#include "render/renderer_state.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace blush {

// Of a pass.
int64_t Renderer::State::light_path_tiles() const { return (learned.light_paths().paths() + tile_capacity - 1) / tile_capacity; }

// One pass for each of these samples, if light paths pay.
bool Renderer::State::trace_light_paths(int64_t first, int64_t count, const Wanted& wanted) {
    if (!add_replacement_passes(first, count, wanted)) return false;
    if (early_splats) return trace_early_light_paths(first, count, wanted);
    return !splats || trace_tiles_of_passes(learned.light_path_pass(scene.tables()), first, count, {0, light_path_tiles()}, wanted);
}

bool Renderer::State::trace_early_light_paths(int64_t first, int64_t count, const Wanted& wanted) {
    const auto pass = learned.early_light_paths(scene.tables(), int64_t(film.width()) * film.height());
    return !pass || trace_tiles_of_passes(*pass, first, count, {0, (pass->paths + tile_capacity - 1) / tile_capacity}, wanted);
}

bool Renderer::State::begin_first_pass(const Wanted& wanted) {
    if (!add_replacement_passes(0, 1, wanted)) return false;
    return early_splats ? trace_early_light_paths(0, 1, wanted) : !splats || add_to_first_pass(wanted);
}

// So many light paths of the pass of a lone first sample that they take about as long as its camera paths: one for each.
bool Renderer::State::add_to_first_pass(const Wanted& wanted) {
    const int64_t tiles = light_path_tiles(), pixels = int64_t(film.width()) * film.height();
    const int64_t end = std::min(first_pass_tiles + std::max<int64_t>(1, pixels / tile_capacity), tiles);
    if (!trace_tiles_of_passes(learned.light_path_pass(scene.tables()), 0, 1, {first_pass_tiles, end}, wanted)) return false;
    first_pass_tiles = end < tiles ? end : 0;
    return true;
}

bool Renderer::State::complete_first_pass(const Wanted& wanted) {
    while (first_pass_tiles > 0)
        if (!add_to_first_pass(wanted)) return false;
    return true;
}

bool Renderer::lacks_light_paths() const { return state_->first_pass_tiles > 0; }
bool Renderer::add_light_paths(const std::function<bool()>& wanted) { return state_->add_to_first_pass(wanted); }

// The light paths of a pass are one sequence of points, so the first of them are spread as evenly as all.
bool Renderer::State::trace_tiles_of_passes(const LightPathPass& each, int64_t first, int64_t count, const TileRange& range,
                                            const Wanted& wanted) {
    KernelContext context = context_for(each.tables, film.width(), film.height());
    context.seed = settings.seed;
    context.settings.reuse = {};
    std::vector<std::vector<Splat>> of_tile(size_t(range.end - range.begin));
    const TickRate rate;
    for (int64_t pass = first; pass < first + count; ++pass) {
        const bool all = workers.for_each(range.end - range.begin, wanted, [&](int64_t i, unsigned worker) {
            TileScratch& tile = scratch_of(worker);
            const int64_t begin = (range.begin + i) * tile_capacity;
            const LightPathTile job{pass, each.paths, begin, int(std::min<int64_t>(tile_capacity, each.paths - begin))};
            trace_light_path_tile(context, kernel_for(each.tables), *each.emission, job, tile);
            std::swap(of_tile[size_t(i)], tile.light_paths->splats);
        });
        collect_counts(rate);
        if (!all) return false;
        const std::vector<std::span<const Splat>> lists(of_tile.begin(), of_tile.end());
        film.add_pass(pass, lists, workers, settings.seed, std::min(1.0, double(range.end * tile_capacity) / double(each.paths)));
    }
    return true;
}

} // namespace blush
