#include "render/pilots/reuse_pilot.h"

#include "render/integrator/reuse_groups.h"
#include "render/pilots/pilot_tiles.h"
#include "render/pilots/reuse_choice.h"
#include "render/pilots/variant_comparison.h"

#include <array>
#include <utility>

namespace blush {
namespace {

constexpr uint32_t reuse_pilot_seed = 0x9110737e; // any; it only has to differ from those of images

// Usual time, relative to a camera or bounce ray (variant_comparison.cpp).
constexpr double connection_cost = 0.25;
constexpr double sharing_cost = 0.08; // per camera path

using PairsOfSizes = std::array<VariantPair, automatic_group_sizes.size()>;

PairsOfSizes compare(const VariantTile& apart, const std::vector<VariantTile>& shared, double ray_cost) {
    std::vector<const VariantTile*> all{&apart};
    for (const VariantTile& v : shared) all.push_back(&v);
    const Vec3d mean = mean_of(all);
    VariantSums without = sums_of(apart, mean);
    without.work = path_work(apart, ray_cost);
    PairsOfSizes pairs;
    for (size_t k = 0; k < shared.size(); ++k) {
        pairs[k] = {sums_of(shared[k], mean), without};
        pairs[k].with.work = without.work + connection_cost * double(shared[k].shadow_rays - apart.shadow_rays) +
                             sharing_cost * double(shared[k].camera_rays);
    }
    return pairs;
}

} // namespace

std::optional<PilotFigures> measure_path_reuse(const KernelContext& context, const Kernel& kernel, const Workers& workers,
                                               std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted) {
    KernelContext apart = context;
    apart.seed = reuse_pilot_seed;
    apart.settings.reuse = {};
    std::vector<KernelContext> sizes(automatic_group_sizes.size(), apart);
    for (size_t k = 0; k < sizes.size(); ++k)
        sizes[k].settings.reuse = reuse_groups(automatic_group_sizes[k], pilot_tile_side, pilot_tile_side);
    const std::vector<TileJob> tiles = pilot_tiles(int(context.settings.width), int(context.settings.height));
    const double ray_cost = ray_cost_of(context);
    std::array<std::vector<VariantPair>, automatic_group_sizes.size()> measured;
    for (auto& of_size : measured) of_size.resize(tiles.size());
    const bool all = TileRunner{workers, scratch, wanted}.for_each(tiles.size(), [&](size_t i, TileScratch& tile_scratch) {
        const TileJob& tile = tiles[i];
        const VariantTile without = render_variant(apart, kernel, tile, tile_scratch);
        std::vector<VariantTile> with;
        for (const KernelContext& size : sizes) with.push_back(render_variant(size, kernel, tile, tile_scratch));
        const PairsOfSizes pairs = compare(without, with, ray_cost);
        for (size_t k = 0; k < pairs.size(); ++k) measured[k][i] = pairs[k];
    });
    if (!all) return std::nullopt;
    std::optional<PilotFigures> best;
    for (size_t k = 0; k < automatic_group_sizes.size(); ++k) {
        PilotFigures figures = figures_of(measured[k]);
        figures.group_size = automatic_group_sizes[k];
        if (!best || figures.cost() < best->cost()) best = figures;
    }
    return best;
}

} // namespace blush
