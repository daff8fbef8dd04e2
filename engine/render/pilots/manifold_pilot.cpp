#include "render/pilots/manifold_pilot.h"

#include "render/pilots/pilot_tiles.h"
#include "render/pilots/variant_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace blush {
namespace {

constexpr uint32_t manifold_seed = 0x5eed3a1f; // any; differs from those of images and other pilots
constexpr int manifold_pixels = 1 << 12;       // of the image that is measured
// Of the receivers with a solution: more must not be cut off at the pilot's limit of trials.
constexpr double largest_cut_share = 2e-3;

struct MeasuredTile {
    VariantPair pair;
    int64_t solutions = 0, cut = 0;
};

// Of the tile without manifold sampling: with it, but for the light of its solutions, whose moments `columns` has by slot.
VariantSums sums_without(const VariantSums& with, const ManifoldColumns& columns, int slots, const Vec3d& mean) {
    // The squared difference of the halves has half of a sample's variance for each channel, divided by a quarter of the samples.
    constexpr double per_sample = 2.0 / pilot_samples;
    VariantSums sums = with;
    const double relative =
        1 / (mean.x * mean.x + dark_squared) + 1 / (mean.y * mean.y + dark_squared) + 1 / (mean.z * mean.z + dark_squared);
    double difference = 0;
    for (int slot = 0; slot < slots; ++slot) {
        const double d = double(columns.base_moment[slot]) - double(columns.own_moment[slot]);
        if (std::isfinite(d)) difference += d;
    }
    difference *= 2 * per_sample / pilot_samples;
    sums.mse = std::max(sums.mse + 3 * difference, 0.05 * sums.mse);
    sums.relmse = std::max(sums.relmse + relative * difference, 0.05 * sums.relmse);
    return sums;
}

} // namespace

std::optional<ManifoldPilot> measure_manifolds(KernelContext context, const CausticPhotons& photons, const CausticCasterTables& casters,
                                               const Kernel& kernel, const Kernel& without, const Workers& workers,
                                               std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted) {
    auto seeds = ManifoldSeedTable::make(photons.chains, *context.scene, wanted);
    if (!seeds) return std::nullopt;
    ManifoldPilot pilot{*std::move(seeds), {}};
    if (pilot.seeds.empty()) return pilot;
    const PilotImage image = pilot_image(context.settings, manifold_pixels);
    context.settings.reuse = {};
    context.settings.max_bounces = pilot_max_bounces;
    context.settings.width = float(image.width);
    context.settings.height = float(image.height);
    context.seed = manifold_seed;
    SceneTables tables = *context.scene;
    tables.manifolds = pilot.seeds.tables(casters);
    tables.manifolds.guides_without = tables.guides;
    tables.guides = {};
    KernelContext with = context;
    with.scene = &tables;
    const double ray_cost = ray_cost_of(context);
    std::vector<MeasuredTile> measured(image.tiles.size());
    const bool done = workers.for_each(int64_t(image.tiles.size()), wanted, [&](int64_t i, unsigned worker) {
        if (!scratch[worker]) scratch[worker] = std::make_unique<TileScratch>();
        TileScratch& tile = *scratch[worker];
        const TileJob& job = image.tiles[size_t(i)];
        MeasuredTile& m = measured[size_t(i)];
        tile.manifolds = std::make_unique<ManifoldColumns>();
        tile.manifolds->begin_measuring(job.paths());
        const Variant by_manifolds = render_variant(with, kernel, job, tile);
        const auto columns = std::exchange(tile.manifolds, nullptr);
        const Variant other = render_variant(context, without, job, tile);
        const std::array<const Variant*, 1> known{&by_manifolds};
        const Vec3d mean = mean_of(known);
        m.pair.with = sums_of(by_manifolds, mean);
        m.pair.without = sums_without(m.pair.with, *columns, job.paths(), mean);
        m.pair.with.work = path_work(by_manifolds, ray_cost);
        m.pair.without.work = path_work(other, ray_cost);
        m.solutions = columns->solutions;
        m.cut = columns->cut;
    });
    if (!done) return std::nullopt;
    std::vector<VariantPair> pairs;
    int64_t solutions = 0, cut = 0;
    for (const MeasuredTile& m : measured) {
        pairs.push_back(m.pair);
        solutions += m.solutions;
        cut += m.cut;
    }
    if (solutions == 0) return pilot;
    pilot.figures = figures_of(pairs);
    pilot.endless = double(cut) > largest_cut_share * double(solutions);
    return pilot;
}

} // namespace blush
