// Traces light paths for samples of the image, pass by pass.
#include "render/film/splat.h"
#include "render/renderer_state.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace blush {

// One pass for each of these samples, if light paths pay.
bool Renderer::State::trace_light_paths(int64_t first, int64_t count, const Wanted& wanted) {
    if (!add_replacement_passes(first, count, wanted)) return false;
    if (!splats) return true;
    const SceneTables tables = learned.light_path_tables(scene.tables());
    KernelContext context = context_for(tables, film.width(), film.height());
    context.seed = settings.seed;
    context.settings.reuse = {};
    const int64_t paths = learned.light_paths().paths();
    const auto tiles = size_t((paths + tile_capacity - 1) / tile_capacity);
    std::vector<std::vector<Splat>> of_tile(tiles);
    const TickRate rate;
    for (int64_t pass = first; pass < first + count; ++pass) {
        const bool traced = workers.for_each(int64_t(tiles), wanted, [&](int64_t i, unsigned worker) {
            TileScratch& tile = scratch_of(worker);
            const int64_t begin = i * tile_capacity;
            const LightPathTile job{pass, paths, begin, int(std::min<int64_t>(tile_capacity, paths - begin))};
            trace_light_path_tile(context, kernel_for(tables), learned.light_paths().emission(), job, tile);
            std::swap(of_tile[size_t(i)], tile.light_paths->splats);
        });
        collect_counts(rate);
        if (!traced) return false;
        const std::vector<std::span<const Splat>> lists(of_tile.begin(), of_tile.end());
        film.add_pass(pass, lists, workers, settings.seed);
    }
    return true;
}

} // namespace blush
