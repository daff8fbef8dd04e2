#include "render/comparison/bidirectional.h"

#include <algorithm>

namespace blush {
namespace {

constexpr int64_t pixels_per_tile = 1024;

// As of generate_paths() (wavefront.h).
Sampler<float> sampler_of(const KernelContext& context, int x, int y, int64_t sample) {
    const uint32_t random = randomisation(context.seed, uint32_t(sample & 1)), index = uint32_t(sample >> 1);
    return context.settings.sampler == SamplerType::random ? independent_sampler<float>(uint32_t(x), uint32_t(y), random, index)
                                                           : pixel_sampler<float>(uint32_t(x), uint32_t(y), random, index);
}

} // namespace

void BidirectionalScene::prepare(const PreparationContext& context) {
    const SceneTables& tables = *context.kernel.scene;
    emission_ = tables.lights.count > 0 ? LightPathEmission::of_all_lights(tables, context.scene) : LightPathEmission();
}

KernelContext BidirectionalScene::context(const KernelContext& whole, SceneTables& tables) const {
    KernelContext context = whole;
    tables = *whole.scene;
    tables.emission = emission_.tables(whole.settings.width * whole.settings.height);
    tables.guides = {};
    tables.panes = false;
    context.scene = &tables;
    return context;
}

bool Bidirectional::prepare(const PreparationContext& context) {
    scene_.prepare(context);
    return true;
}

bool Bidirectional::trace_pass(int64_t sample, const PreparationContext& whole, std::vector<std::vector<Splat>>& tiles) {
    SceneTables tables;
    const KernelContext context = scene_.context(whole.kernel, tables);
    const int width = int(context.settings.width);
    const int64_t pixels = int64_t(width) * int64_t(context.settings.height);
    tiles.assign(size_t((pixels + pixels_per_tile - 1) / pixels_per_tile), {});
    return whole.workers.for_each(int64_t(tiles.size()), whole.wanted, [&](int64_t tile, unsigned) {
        BidirectionalPaths paths(context, scene_.emission());
        const int64_t end = std::min(pixels, (tile + 1) * pixels_per_tile);
        for (int64_t pixel = tile * pixels_per_tile; pixel < end; ++pixel) {
            const int x = int(pixel % width), y = int(pixel / width);
            const Sampler<float> sampler = sampler_of(context, x, y, sample);
            SamplerPairs random(sampler);
            paths.trace(random, {x, y, random.pair(0), random.pair(1)}, sampler, tiles[size_t(tile)]);
        }
    });
}

} // namespace blush
