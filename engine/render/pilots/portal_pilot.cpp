#include "render/pilots/portal_pilot.h"

#include "render/pilots/pilot_tiles.h"
#include "render/pilots/variant_comparison.h"

#include <array>
#include <utility>

namespace blush {
namespace {

// Any; they only have to differ from each other and from those of images.
constexpr uint32_t portal_learning_seed = 0x9074a150, portal_measuring_seed = 0x9074a151;
constexpr double min_reach = 0.02; // share of the rays

} // namespace

std::optional<PortalPilot> learn_portals(KernelContext context, const Kernel& kernel, const Workers& workers,
                                         std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted) {
    context.settings.reuse = {};
    context.settings.max_bounces = pilot_max_bounces;
    const std::vector<TileJob> tiles = pilot_tiles(int(context.settings.width), int(context.settings.height));
    const TileRunner runner{workers, scratch, wanted};
    context.seed = portal_learning_seed;
    std::vector<std::vector<EscapeTrial>> of_tile(tiles.size());
    const bool learned = runner.for_each(tiles.size(), [&](size_t i, TileScratch& tile) {
        tile.escapes = std::make_unique<EscapeTrials>();
        kernel.render(context, tiles[i], tile);
        of_tile[i] = std::move(std::exchange(tile.escapes, nullptr)->all);
    });
    if (!learned) return std::nullopt;
    std::vector<EscapeTrial> trials;
    for (const auto& some : of_tile) trials.insert(trials.end(), some.begin(), some.end());
    PortalPilot pilot{LearnedPortals(trials, context.scene->environment, context.scene->lights.count == 0), {}};
    if (pilot.portals.reach() < min_reach) return pilot;

    context.seed = portal_measuring_seed;
    SceneTables tables = *context.scene;
    tables.lights.portals = pilot.portals.tables();
    KernelContext with_portals = context;
    with_portals.scene = &tables;
    const double ray_cost = ray_cost_of(context);
    std::vector<VariantPair> pairs(tiles.size());
    const bool measured = runner.for_each(tiles.size(), [&](size_t i, TileScratch& tile) {
        const VariantTile with = render_variant(with_portals, kernel, tiles[i], tile);
        const VariantTile without = render_variant(context, kernel, tiles[i], tile);
        const Vec3d mean = mean_of(std::array{&with, &without});
        pairs[i] = {sums_of(with, mean), sums_of(without, mean)};
        pairs[i].with.work = path_work(with, ray_cost);
        pairs[i].without.work = path_work(without, ray_cost);
    });
    if (!measured) return std::nullopt;
    pilot.figures = figures_of(pairs);
    return pilot;
}

} // namespace blush
