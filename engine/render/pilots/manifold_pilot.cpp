#include "render/pilots/manifold_pilot.h"

#include "render/pilots/pilot_tiles.h"
#include "render/pilots/variant_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace blush {
namespace {

constexpr uint32_t manifold_seed = 0x5eed3a1f; // any; differs from those of images and other pilots
constexpr int manifold_pixels = 1 << 12;       // of the image that is measured
// LightVertexTables::walk_share: of 1, 0.3, 0.1 and 0.03 the least error times time in the pool of docs/dev/performance.md.
constexpr float walk_share = 0.1f;
constexpr double largest_shared_cost = 0.95; // the rays with which light paths trace their chains again are not counted
// Of the receivers with a solution: more must not be cut off at the pilot's limit of trials.
constexpr double largest_cut_share = 2e-3;

struct MeasuredTile {
    VariantPair pair;   // with and without manifold sampling,
    VariantPair shared; // and of that, with and without shared chains
    Vec3d mean;
    int64_t solutions = 0, cut = 0;
};

// A tile with light vertices, and the logarithms of their ratios (LightVertexColumns::ratio).
struct VertexTile {
    VariantPair pair;
    double log_ratio = 0;
    int64_t ratios = 0;
};
VertexTile measure_ratios(const KernelContext& context, const Kernel& kernel, const TileJob& job, TileScratch& tile) {
    KernelContext vertices_alone = context;
    vertices_alone.settings.max_bounces = 0;
    render_variant(vertices_alone, kernel, job, tile);
    const LightVertexColumns& v = *tile.light_vertices;
    VertexTile m;
    for (int slot = 0; slot < job.paths(); ++slot) {
        if (v.chain[slot] == 0 || !(v.ratio[slot] > 0)) continue;
        m.log_ratio += std::log(double(v.ratio[slot]));
        ++m.ratios;
    }
    return m;
}

// Of the tile with more second moment in its samples.
VariantSums with_moment(const VariantSums& with, double moment, const Vec3d& mean) {
    // The squared difference of the halves has half of a sample's variance for each channel, divided by a quarter of the samples.
    constexpr double per_sample = 2.0 / pilot_samples;
    VariantSums sums = with;
    const double relative =
        1 / (mean.x * mean.x + dark_squared) + 1 / (mean.y * mean.y + dark_squared) + 1 / (mean.z * mean.z + dark_squared);
    const double difference = moment * 2 * per_sample / pilot_samples;
    sums.mse = std::max(sums.mse + 3 * difference, 0.05 * sums.mse);
    sums.relmse = std::max(sums.relmse + relative * difference, 0.05 * sums.relmse);
    return sums;
}

// Of the tile without manifold sampling: with it, but for the light of its solutions, whose moments `columns` has by slot.
VariantSums sums_without(const VariantSums& with, const ManifoldColumns& columns, int slots, const Vec3d& mean) {
    double difference = 0;
    for (int slot = 0; slot < slots; ++slot) {
        const double d = double(columns.base_moment[slot]) - double(columns.own_moment[slot]);
        if (std::isfinite(d)) difference += d;
    }
    return with_moment(with, difference, mean);
}

// Decides whether chains are shared. The other figures are those with shared chains in any case: where these do not pay, the difference is
// noise.
void decide_sharing(std::span<const MeasuredTile> measured, std::optional<bool> shares, ManifoldPilot& pilot) {
    std::vector<VariantPair> shared;
    for (const MeasuredTile& m : measured) shared.push_back(m.shared);
    pilot.shared_figures = figures_of(shared);
    pilot.shares = shares ? *shares : pilot.shared_figures->cost() < largest_shared_cost;
}

// Renders the tiles of manifold sampling with light vertices, too. `context`: with manifold sampling. False if `wanted` returned false.
bool measure_light_vertices(KernelContext context, const PilotImage& image, std::span<const MeasuredTile> without, const Kernel& kernel,
                            const TileRunner& runner, ManifoldPilot& pilot) {
    SceneTables tables = *context.scene;
    tables.light_vertices = pilot.light_vertices();
    if (tables.light_vertices.empty()) return true;
    context.scene = &tables;
    std::vector<VertexTile> measured(image.tiles.size());
    if (!runner.for_each(measured.size(),
                         [&](size_t i, TileScratch& tile) { measured[i] = measure_ratios(context, kernel, image.tiles[i], tile); }))
        return false;
    double log_ratio = 0;
    int64_t ratios = 0;
    for (const VertexTile& m : measured) {
        log_ratio += m.log_ratio;
        ratios += m.ratios;
    }
    if (ratios == 0) return true;
    pilot.usual_ratio = float(std::exp(log_ratio / double(ratios)));
    tables.light_vertices = pilot.light_vertices();
    const double ray_cost = ray_cost_of(context);
    if (!runner.for_each(measured.size(), [&](size_t i, TileScratch& tile) {
            const VariantTile with = render_variant(context, kernel, image.tiles[i], tile);
            VariantPair& pair = measured[i].pair;
            pair.without = without[i].pair.with;
            pair.with = sums_of(with, without[i].mean);
            pair.with.work = path_work(with, ray_cost);
        }))
        return false;
    std::vector<VariantPair> pairs;
    for (const VertexTile& m : measured) pairs.push_back(m.pair);
    pilot.vertex_figures = figures_of(pairs);
    return true;
}

} // namespace

LightVertexTables ManifoldPilot::light_vertices() const {
    if (emission.empty()) return {};
    return {emission.tables(1), emission.tables(1), usual_ratio, walk_share};
}

std::optional<ManifoldPilot> measure_manifolds(KernelContext context, const CausticPhotons& photons, const CasterSphere& scene_sphere,
                                               const CausticCasterTables& casters, std::optional<bool> shares, bool disperses,
                                               const Kernel& kernel, const Kernel& without, const Workers& workers,
                                               std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted) {
    auto seeds = ManifoldSeedTable::make(photons.chains, *context.scene, workers, wanted);
    if (!seeds) return std::nullopt;
    ManifoldPilot pilot{.seeds = *std::move(seeds), .figures = {}, .emission = {}};
    if (pilot.seeds.empty()) return pilot;
    const PilotImage image = pilot_image(context.settings, manifold_pixels);
    SceneTables tables_without = *context.scene;
    // As many light paths for each pixel as the image has.
    tables_without.emission.paths *= float(image.width) * float(image.height) / (context.settings.width * context.settings.height);
    context.scene = &tables_without;
    SceneTables tables = tables_without;
    tables.manifolds = pilot.seeds.tables(casters);
    // Light vertices are not connected through panes and blended surfaces; their light paths do not have the wavelength of the camera's
    // path.
    if (!tables.panes && !tables.blends && !disperses)
        pilot.emission =
            LightPathEmission(tables, scene_sphere, [&](int32_t light) { return tables.manifolds.group_of_light[light] >= 0; });
    context.settings.reuse = {};
    context.settings.max_bounces = pilot_max_bounces;
    context.settings.width = float(image.width);
    context.settings.height = float(image.height);
    context.seed = manifold_seed;
    KernelContext with = context;
    with.scene = &tables;
    tables.manifolds.guides_without = tables.guides;
    tables.guides = {};
    const double ray_cost = ray_cost_of(context);
    const TileRunner runner{workers, scratch, wanted};
    std::vector<MeasuredTile> measured(image.tiles.size());
    const bool done = runner.for_each(measured.size(), [&](size_t i, TileScratch& tile) {
        const TileJob& job = image.tiles[i];
        MeasuredTile& m = measured[i];
        tile.manifolds = std::make_unique<ManifoldColumns>();
        tile.manifolds->begin_measuring(job.paths());
        const VariantTile by_manifolds = render_variant(with, kernel, job, tile);
        const auto columns = std::exchange(tile.manifolds, nullptr);
        const VariantTile other = render_variant(context, without, job, tile);
        const std::array<const VariantTile*, 1> known{&by_manifolds};
        m.mean = mean_of(known);
        m.pair.with = sums_of(by_manifolds, m.mean);
        m.pair.without = sums_without(m.pair.with, *columns, job.paths(), m.mean);
        m.pair.with.work = path_work(by_manifolds, ray_cost);
        m.pair.without.work = path_work(other, ray_cost);
        const double saving = std::isfinite(columns->shared_saving) ? columns->shared_saving : 0;
        m.shared = {m.pair.with, with_moment(m.pair.with, saving, m.mean)};
        m.shared.without.work -= ray_cost * double(columns->shared_rays);
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
    if (!tables.emission.empty()) decide_sharing(measured, shares, pilot);
    tables.manifolds.shares = pilot.shares;
    pilot.figures = figures_of(pairs);
    pilot.endless = double(cut) > largest_cut_share * double(solutions);
    if (!measure_light_vertices(with, image, measured, kernel, runner, pilot)) return std::nullopt;
    return pilot;
}

} // namespace blush
