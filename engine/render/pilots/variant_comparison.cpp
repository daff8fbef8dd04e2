#include "render/pilots/variant_comparison.h"

#include "render/bvh/small_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace blush {
namespace {

constexpr double small_scene_cost = 0.65; // factor on paths where no BVH is needed (small_scene.h)

} // namespace

VariantTile render_variant(const KernelContext& context, const Kernel& kernel, const TileJob& tile, TileScratch& scratch) {
    scratch.camera_rays = scratch.bounce_rays = scratch.shadow_rays = 0;
    kernel.render(context, tile, scratch);
    VariantTile v;
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

VariantSums& VariantSums::operator+=(const VariantSums& more) {
    mse += more.mse;
    relmse += more.relmse;
    work += more.work;
    return *this;
}

VariantSums sums_of(const VariantTile& v, const Vec3d& mean) {
    VariantSums sums;
    for (size_t i = 0; i < v.means.size(); i += 2) {
        const Vec3d d = v.means[i] - v.means[i + 1];
        const auto relative = [](double difference, double about) { return difference * difference / (about * about + dark_squared); };
        sums.mse += dot(d, d);
        sums.relmse += relative(d.x, mean.x) + relative(d.y, mean.y) + relative(d.z, mean.z);
    }
    return sums;
}

Vec3d mean_of(std::span<const VariantTile* const> variants) {
    Vec3d sum{0, 0, 0};
    for (const VariantTile* v : variants)
        for (const Vec3d& mean : v->means) sum = sum + mean;
    return sum * (1 / double(variants.size() * variants[0]->means.size()));
}

double path_work(const VariantTile& v, double ray_cost) { return ray_cost * (double(v.rays) + shadow_ray_cost * double(v.shadow_rays)); }

double ray_cost_of(const KernelContext& context) { return context.accel->small_scene() ? small_scene_cost : 1; }

PilotFigures figures_of(std::span<const VariantPair> tiles) {
    // 1 for a tile without error.
    const auto ratio = [](double with, double without) { return with > 0 && without > 0 ? with / without : 1.0; };
    VariantSums with, without;
    double log_ratios = 0;
    int noisy_tiles = 0;
    for (const VariantPair& tile : tiles) {
        with += tile.with;
        without += tile.without;
        log_ratios += std::log(ratio(tile.with.relmse, tile.without.relmse));
        noisy_tiles += tile.with.relmse > 0 && tile.without.relmse > 0;
    }
    return {ratio(with.mse, without.mse), ratio(with.relmse, without.relmse), std::exp(log_ratios / std::max(noisy_tiles, 1)),
            ratio(with.work, without.work)};
}

} // namespace blush
