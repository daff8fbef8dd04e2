#include "render/pilots/visibility_pilot.h"

#include "render/pilots/pilot_tiles.h"

#include <utility>

namespace blush {
namespace {

constexpr uint32_t visibility_pilot_seed = 0x51b11e0d; // any; it only has to differ from those of images and of the other pilot

} // namespace

std::optional<LightVisibility> learn_light_visibility(KernelContext context, const Kernel& kernel, const Workers& workers,
                                                      std::vector<std::unique_ptr<TileScratch>>& scratch,
                                                      const std::function<bool()>& wanted) {
    context.seed = visibility_pilot_seed;
    context.settings.reuse = {};
    context.settings.max_bounces = pilot_max_bounces;
    const std::vector<TileJob> tiles = pilot_tiles(int(context.settings.width), int(context.settings.height));
    std::vector<std::vector<ShadowTrial>> of_tile(tiles.size());
    const bool all = TileRunner{workers, scratch, wanted}.for_each(tiles.size(), [&](size_t i, TileScratch& tile) {
        tile.trials = std::make_unique<std::vector<ShadowTrial>>();
        kernel.render(context, tiles[i], tile);
        of_tile[i] = std::move(*std::exchange(tile.trials, nullptr));
    });
    if (!all) return std::nullopt;
    std::vector<ShadowTrial> trials;
    for (const auto& some : of_tile) trials.insert(trials.end(), some.begin(), some.end());
    return LightVisibility(trials, context.scene->lights);
}

} // namespace blush
