#include "render/film/reuse_pilot.h"

#include "render/bvh/small_scene.h"
#include "render/film/pilot_tiles.h"
#include "render/film/reuse_choice.h"
#include "render/integrator/reuse_groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace blush {
namespace {

constexpr uint32_t pilot_seed = 0x9110737e; // any; it only has to differ from those of images
constexpr double dark_squared = 0.01;       // as in relmse

// Usual time of parts of the work, relative to a camera or bounce ray with its shading, of 0.1 us: from the profiles by stage of the
// shipped scenes (stage_times.h).
constexpr double shadow_ray_cost = 0.3, connection_cost = 0.25;
constexpr double sharing_cost = 0.08;     // per camera path
constexpr double small_scene_cost = 0.65; // factor on paths where no BVH is needed (small_scene.h)

// A tile rendered in one way.
struct Variant {
    std::vector<Vec3d> means; // of the halves of each pixel, adjacent
    int64_t rays = 0, shadow_rays = 0, camera_rays = 0;
};

Variant render_variant(const KernelContext& context, const Kernel& kernel, const TileJob& tile, TileScratch& scratch) {
    scratch.camera_rays = scratch.bounce_rays = scratch.shadow_rays = 0;
    kernel.render(context, tile, scratch);
    Variant v;
    v.camera_rays = std::exchange(scratch.camera_rays, 0);
    v.rays = v.camera_rays + std::exchange(scratch.bounce_rays, 0);
    v.shadow_rays = std::exchange(scratch.shadow_rays, 0);
    v.means.assign(2 * size_t(tile.width) * size_t(tile.height), Vec3d{0, 0, 0});
    for (int slot = 0; slot < tile.paths(); ++slot) {
        const Vec3d radiance{scratch.r[slot], scratch.g[slot], scratch.b[slot]};
        const bool valid = std::isfinite(radiance.x + radiance.y + radiance.z);
        Vec3d& mean = v.means[2 * size_t(slot / pilot_samples) + size_t(slot % 2)];
        if (valid) mean = mean + radiance * (2.0 / pilot_samples);
    }
    return v;
}

// Sums over pixels and channels of squared errors, and the work.
struct Sums {
    double mse = 0, relmse = 0, work = 0;
    Sums& operator+=(const Sums& more) {
        mse += more.mse;
        relmse += more.relmse;
        work += more.work;
        return *this;
    }
};
using SumsOfSizes = std::array<Sums, automatic_group_sizes.size()>;
// Of one tile, or of all.
struct Comparison {
    Sums apart;
    SumsOfSizes shared;
};

Sums sums_of(const Variant& v, const Vec3d& mean) {
    Sums sums;
    for (size_t i = 0; i < v.means.size(); i += 2) {
        const Vec3d d = v.means[i] - v.means[i + 1];
        const auto relative = [](double difference, double about) { return difference * difference / (about * about + dark_squared); };
        sums.mse += dot(d, d);
        sums.relmse += relative(d.x, mean.x) + relative(d.y, mean.y) + relative(d.z, mean.z);
    }
    return sums;
}

Comparison compare(const Variant& apart, const std::vector<Variant>& shared, double ray_cost) {
    Vec3d sum{0, 0, 0};
    const auto add_means = [&](const Variant& v) {
        for (const Vec3d& mean : v.means) sum = sum + mean;
    };
    add_means(apart);
    for (const Variant& v : shared) add_means(v);
    const Vec3d mean = sum * (1 / double((1 + shared.size()) * apart.means.size()));
    Comparison c;
    c.apart = sums_of(apart, mean);
    c.apart.work = ray_cost * (double(apart.rays) + shadow_ray_cost * double(apart.shadow_rays));
    for (size_t k = 0; k < shared.size(); ++k) {
        c.shared[k] = sums_of(shared[k], mean);
        c.shared[k].work = c.apart.work + connection_cost * double(shared[k].shadow_rays - apart.shadow_rays) +
                           sharing_cost * double(shared[k].camera_rays);
    }
    return c;
}

// Of the k-th size of groups.
PilotFigures figures_of(const std::vector<Comparison>& tiles, size_t k) {
    // 1 for a tile without error.
    const auto ratio = [](double with, double without) { return with > 0 && without > 0 ? with / without : 1.0; };
    Sums apart, shared;
    double log_ratios = 0;
    int noisy_tiles = 0;
    for (const Comparison& tile : tiles) {
        apart += tile.apart;
        shared += tile.shared[k];
        log_ratios += std::log(ratio(tile.shared[k].relmse, tile.apart.relmse));
        noisy_tiles += tile.apart.relmse > 0 && tile.shared[k].relmse > 0;
    }
    return {ratio(shared.mse, apart.mse), ratio(shared.relmse, apart.relmse), std::exp(log_ratios / std::max(noisy_tiles, 1)),
            ratio(shared.work, apart.work), automatic_group_sizes[k]};
}

} // namespace

std::optional<PilotFigures> measure_path_reuse(const KernelContext& context, const Kernel& kernel, const Workers& workers,
                                               std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted) {
    KernelContext apart = context;
    apart.seed = pilot_seed;
    apart.settings.reuse = {};
    std::vector<KernelContext> sizes(automatic_group_sizes.size(), apart);
    for (size_t k = 0; k < sizes.size(); ++k)
        sizes[k].settings.reuse = reuse_groups(automatic_group_sizes[k], pilot_tile_side, pilot_tile_side);
    const std::vector<TileJob> tiles = pilot_tiles(int(context.settings.width), int(context.settings.height));
    const double ray_cost = context.accel->small_scene() ? small_scene_cost : 1;
    std::vector<Comparison> measured(tiles.size());
    const bool all = workers.for_each(int64_t(tiles.size()), wanted, [&](int64_t i, unsigned worker) {
        if (!scratch[worker]) scratch[worker] = std::make_unique<TileScratch>();
        const TileJob& tile = tiles[size_t(i)];
        const Variant without = render_variant(apart, kernel, tile, *scratch[worker]);
        std::vector<Variant> with;
        for (const KernelContext& size : sizes) with.push_back(render_variant(size, kernel, tile, *scratch[worker]));
        measured[size_t(i)] = compare(without, with, ray_cost);
    });
    if (!all) return std::nullopt;
    PilotFigures best = figures_of(measured, 0);
    for (size_t k = 1; k < automatic_group_sizes.size(); ++k)
        if (const PilotFigures figures = figures_of(measured, k); figures.cost() < best.cost()) best = figures;
    return best;
}

} // namespace blush
