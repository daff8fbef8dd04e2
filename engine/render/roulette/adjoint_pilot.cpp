#include "render/roulette/adjoint_pilot.h"

#include "render/integrator/reuse_groups.h"
#include "render/pilots/pilot_tiles.h"
#include "render/pilots/variant_comparison.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace blush {
namespace {

// Any; they only have to differ from each other and from those of images and of other pilots.
constexpr uint32_t learning_seed = 0xad10017e, comparison_seed = 0xad10017f;
constexpr int max_pixels = 1 << 14, min_pixels = 1 << 10, film_pixels_per_pixel = 8; // of the image that is learned from
constexpr int first_samples = 1, learning_samples = 4;                               // of a pixel: for the share of roulette, to learn
// Long enough for what closed rooms reflect, short enough that a room of albedo 1 does not hold the pilot up.
constexpr int longest_paths = 32;
constexpr double least_roulette_share = 0.25; // below, no learned rule was worth its pilot on any measured scene
// Reading the tables takes time that is not counted as work, and a pilot is no more exact than that.
constexpr double largest_cost = 0.9;
// That `automatic` compares. Splitting lost to roulette alone on nearly all measured scenes (docs/dev/performance.md), where a longer pilot
// would cost all images.
constexpr std::array learned_rules{Roulette::Rule::adjoint, Roulette::Rule::efficiency};

// What paths find in the image at a low resolution.
struct Findings {
    AdjointImage image;
    std::vector<ContinuationTrial> trials, arrivals;
    double path_rays = 0, roulette_rays = 0; // those behind the first bounces, where roulette does not act yet
};

KernelContext pilot_context(const KernelContext& context, uint32_t seed) {
    KernelContext pilot = context;
    pilot.seed = seed;
    pilot.settings.reuse = {};
    pilot.settings.max_bounces = longest_paths;
    return pilot;
}

// A tile of the image; its samples go to `image`.
Findings find_in_tile(const KernelContext& context, const Kernel& kernel, const TileJob& job, TileScratch& tile, AdjointImage& image) {
    Findings found;
    tile.camera_rays = tile.bounce_rays = tile.shadow_rays = 0;
    tile.continuations = std::make_unique<ContinuationTrials>();
    if (context.settings.roulette.rule == Roulette::Rule::splitting) tile.arrivals = std::make_unique<ContinuationTrials>();
    tile.roulette = std::make_unique<RouletteColumns>();
    kernel.render(context, job, tile);
    found.trials = std::move(std::exchange(tile.continuations, nullptr)->all);
    if (const auto arrivals = std::exchange(tile.arrivals, nullptr)) found.arrivals = std::move(arrivals->all);
    const auto counted = std::exchange(tile.roulette, nullptr);
    for (int bounce = context.settings.roulette.start; bounce < max_counted_bounces; ++bounce)
        found.roulette_rays += double(counted->counts[bounce].alive);
    found.path_rays = double(std::exchange(tile.camera_rays, 0) + std::exchange(tile.bounce_rays, 0));
    found.image.rays = found.path_rays + shadow_ray_cost * double(std::exchange(tile.shadow_rays, 0));
    for (int slot = 0; slot < job.paths(); ++slot) {
        const int pixel = slot / image.samples, x = job.x + pixel % job.width, y = job.y + pixel / job.width;
        image.luminance[(size_t(y) * size_t(image.width) + size_t(x)) * size_t(image.samples) + size_t(slot % image.samples)] =
            float(dot(luminance_weights, Vec3d{tile.r[slot], tile.g[slot], tile.b[slot]}));
    }
    return found;
}

std::optional<Findings> find_light(const KernelContext& full, int samples, const Kernel& kernel, const Workers& workers,
                                   std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted) {
    KernelContext context = pilot_context(full, learning_seed);
    const double film_pixels = double(full.settings.width) * double(full.settings.height);
    const int pixels = int(std::clamp(film_pixels / film_pixels_per_pixel, double(min_pixels), double(max_pixels)));
    const PilotImage image = pilot_image(context.settings, pixels, samples);
    context.settings.width = float(image.width);
    context.settings.height = float(image.height);
    Findings all;
    all.image = {image.width, image.height, samples, std::vector<float>(size_t(image.width) * size_t(image.height) * size_t(samples)), 0};
    std::vector<Findings> of_tile(image.tiles.size());
    const bool done = workers.for_each(int64_t(image.tiles.size()), wanted, [&](int64_t i, unsigned worker) {
        if (!scratch[worker]) scratch[worker] = std::make_unique<TileScratch>();
        of_tile[size_t(i)] = find_in_tile(context, kernel, image.tiles[size_t(i)], *scratch[worker], all.image);
    });
    if (!done) return std::nullopt;
    for (Findings& tile : of_tile) {
        for (auto trials : {&Findings::trials, &Findings::arrivals}) {
            (all.*trials).insert((all.*trials).end(), (tile.*trials).begin(), (tile.*trials).end());
            tile.*trials = {}; // in closed rooms these are tens of megabytes
        }
        all.image.rays += tile.image.rays;
        all.path_rays += tile.path_rays;
        all.roulette_rays += tile.roulette_rays;
    }
    return all;
}

using Fields = std::array<AdjointField, learned_rules.size()>;
using FiguresOfRules = std::array<PilotFigures, learned_rules.size()>;

// Each learned rule over sqrt, in a part of the image.
std::optional<FiguresOfRules> compare_rules(const KernelContext& full, int group_size, const Fields& fields, const Kernel& kernel,
                                            const Workers& workers, std::vector<std::unique_ptr<TileScratch>>& scratch,
                                            const std::function<bool()>& wanted) {
    KernelContext by_throughput = pilot_context(full, comparison_seed);
    if (group_size > 1) by_throughput.settings.reuse = reuse_groups(group_size, pilot_tile_side, pilot_tile_side);
    const int width = int(full.settings.width), height = int(full.settings.height);
    std::array<SceneTables, learned_rules.size()> tables;
    std::array<KernelContext, learned_rules.size()> contexts;
    for (size_t k = 0; k < fields.size(); ++k) {
        tables[k] = *full.scene;
        tables[k].adjoint = fields[k].tables(width, height);
        contexts[k] = by_throughput;
        contexts[k].scene = &tables[k];
    }
    const std::vector<TileJob> tiles = pilot_tiles(width, height);
    const double ray_cost = ray_cost_of(full);
    std::array<std::vector<VariantPair>, learned_rules.size()> pairs;
    for (auto& of_rule : pairs) of_rule.resize(tiles.size());
    const bool done = workers.for_each(int64_t(tiles.size()), wanted, [&](int64_t i, unsigned worker) {
        if (!scratch[worker]) scratch[worker] = std::make_unique<TileScratch>();
        const auto render = [&](const KernelContext& context) {
            return render_variant(context, kernel, tiles[size_t(i)], *scratch[worker]);
        };
        const VariantTile without = render(by_throughput), adjoint = render(contexts[0]), efficiency = render(contexts[1]);
        const std::array<const VariantTile*, 1 + learned_rules.size()> all{&without, &adjoint, &efficiency};
        const Vec3d mean = mean_of(all);
        const auto sums = [&](const VariantTile& v) {
            VariantSums s = sums_of(v, mean);
            s.work = path_work(v, ray_cost);
            return s;
        };
        for (size_t k = 0; k < pairs.size(); ++k) pairs[k][size_t(i)] = {sums(*all[k + 1]), sums(without)};
    });
    if (!done) return std::nullopt;
    return FiguresOfRules{figures_of(pairs[0]), figures_of(pairs[1])};
}

} // namespace

AdjointPilot roulette_with_manifolds() {
    AdjointPilot pilot;
    pilot.start = 6;
    pilot.why_not = fmt::format("manifold sampling: no path ends before bounce {}, which saves more noise than time", pilot.start);
    return pilot;
}

std::optional<AdjointPilot> learn_adjoint(const KernelContext& context, int group_size, const Kernel& kernel, const Workers& workers,
                                          std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted) {
    AdjointPilot pilot;
    const Roulette::Rule rule = context.settings.roulette.rule;
    if (rule == Roulette::Rule::automatic) {
        const auto first = find_light(context, first_samples, kernel, workers, scratch, wanted);
        if (!first) return std::nullopt;
        const double share = first->roulette_rays / std::max(1.0, first->path_rays);
        pilot.why_not = fmt::format("pilot: roulette prevents {:.0f} % of the rays at most", 100 * share);
        if (share < least_roulette_share) return pilot;
    }
    const auto found = find_light(context, learning_samples, kernel, workers, scratch, wanted);
    if (!found) return std::nullopt;
    if (rule != Roulette::Rule::automatic) {
        pilot.best = rule;
        pilot.field = AdjointField(rule, found->trials, found->arrivals, found->image);
        return pilot;
    }
    Fields fields;
    for (size_t k = 0; k < fields.size(); ++k) fields[k] = AdjointField(learned_rules[k], found->trials, found->arrivals, found->image);
    const auto figures = compare_rules(context, group_size, fields, kernel, workers, scratch, wanted);
    if (!figures) return std::nullopt;
    const size_t best = (*figures)[0].cost() < (*figures)[1].cost() ? 0 : 1;
    pilot.figures = (*figures)[best];
    pilot.best = learned_rules[best];
    if (pilot.figures->cost() <= largest_cost) pilot.field = std::move(fields[best]);
    return pilot;
}

} // namespace blush
