#include "render/diagnostics/light_path_replay.h"

#include "render/integrator/light_paths.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace blush {
namespace {

constexpr size_t most_shown = 3;

// Light that the splats give to a pixel.
Vec3 light_of(const std::vector<Splat>& splats, int pixel, size_t first = 0) {
    Vec3 sum{0, 0, 0};
    for (size_t i = first; i < splats.size(); ++i)
        if (splats[i].pixel == pixel) sum = sum + splats[i].radiance;
    return sum;
}

// As trace_light_paths(), with one path.
ReplayedLightPath replay_light_path(const KernelContext& context, const EmittedPath& emitted, int pixel, TileScratch& scratch) {
    constexpr Features s = all_features.with(Feature::light_paths);
    LightPathColumns& columns = *scratch.light_paths;
    columns.emitted = {emitted};
    columns.splats.clear();
    ReplayedLightPath replayed{.emitted = emitted};
    PathQueue *now = &scratch.paths[0], *next = &scratch.paths[1];
    begin_light_paths(columns, *now);
    begin_light_chains<s>(*context.scene, scratch, *now);
    int queue = 0;
    for (int bounce = 0; now->size > 0 && bounce < context.settings.max_bounces && bounce <= max_path_length; ++bounce) {
        trace_light_rays<s, float>(context, scratch, *now, *next, bounce);
        ReplayedLightVertex vertex{load_path<s, float>(*now, 0), load_hit<float>(scratch.hits, 0), {0, 0, 0}};
        queue = 1 - queue;
        shade_light_paths<s, float>(context, scratch, *now, *next, queue, bounce);
        if (scratch.shadows.size > 0) {
            const size_t first = columns.splats.size();
            add_splats<s, float>(context, scratch, bounce);
            vertex.light = light_of(columns.splats, pixel, first);
        }
        weigh_shared_chains<s, float>(context, scratch, *next, *now);
        replayed.light = replayed.light + vertex.light;
        replayed.vertices.push_back(vertex);
        std::swap(now, next);
    }
    return replayed;
}

} // namespace

PixelLightPaths replay_light_paths(const KernelContext& context, const Kernel& kernel, const LightPathEmission& emission, int64_t paths,
                                   int64_t pass, int x, int y, TileScratch& scratch) {
    const int pixel = y * int(context.settings.width) + x;
    PixelLightPaths result;
    const auto tile_at = [&](int64_t first) {
        return LightPathTile{pass, paths, first, int(std::min<int64_t>(tile_capacity, paths - first))};
    };
    std::vector<std::pair<float, int64_t>> tiles; // brightest splat of each tile that has one
    for (int64_t first = 0; first < paths; first += tile_capacity) {
        trace_light_path_tile(context, kernel, emission, tile_at(first), scratch);
        float brightest = 0;
        for (const Splat& splat : scratch.light_paths->splats) {
            if (splat.pixel != pixel) continue;
            ++result.connections;
            result.light = result.light + splat.radiance;
            brightest = std::max(brightest, luminance(splat.radiance));
        }
        if (brightest > 0) tiles.emplace_back(brightest, first);
    }
    std::ranges::sort(tiles, std::greater{});
    tiles.resize(std::min(tiles.size(), most_shown));
    for (const auto& [brightest, first] : tiles) {
        trace_light_path_tile(context, kernel, emission, tile_at(first), scratch);
        LightPathColumns& columns = *scratch.light_paths;
        for (const EmittedPath& emitted : std::exchange(columns.emitted, {})) {
            columns.emitted = {emitted};
            columns.splats.clear();
            kernel.trace_light_paths(context, scratch);
            if (luminance(light_of(columns.splats, pixel)) > 0)
                result.brightest.push_back(replay_light_path(context, emitted, pixel, scratch));
        }
    }
    std::ranges::stable_sort(result.brightest, std::greater{}, [](const ReplayedLightPath& path) { return luminance(path.light); });
    result.brightest.resize(std::min(result.brightest.size(), most_shown));
    return result;
}

} // namespace blush
