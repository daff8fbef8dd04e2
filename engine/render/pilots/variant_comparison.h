// Compares ways to render the same tiles: errors and counted work. Pilots decide by it.
#pragma once

#include "render/compile/feature_report.h"
#include "render/kernels/kernel.h"
#include "render/pilots/pilot_tiles.h"

#include <span>
#include <vector>

namespace blush {

// Usual time of a shadow ray, relative to a camera or bounce ray with its shading, of 0.1 us: from the profiles by stage of the shipped
// scenes (stage_times.h).
constexpr double shadow_ray_cost = 0.3;
constexpr double dark_squared = 0.01; // as in relmse

// A tile of a pilot rendered in one way.
struct VariantTile {
    std::vector<Vec3d> means; // of the halves of each pixel, adjacent
    int64_t rays = 0, shadow_rays = 0, camera_rays = 0;
};
VariantTile render_variant(const KernelContext& context, const Kernel& kernel, const TileJob& tile, TileScratch& scratch);

// Sums over pixels and channels of squared errors, and the work.
//
// The error of a pixel is half the difference of its two half buffers, which are independent randomisations of the sampler: its square
// estimates the variance of stratified samples. MSE is the sum of these squares; relMSE divides them by the squared mean of the tile.
// The mean of the pixel is no divisor: it would hide fireflies.
struct VariantSums {
    double mse = 0, relmse = 0, work = 0;
    VariantSums& operator+=(const VariantSums& more);
};
// `mean`: of the tile, over all of its variants. Leaves `work` to the caller.
VariantSums sums_of(const VariantTile& v, const Vec3d& mean);
// Mean of a tile over its variants.
Vec3d mean_of(std::span<const VariantTile* const> variants);
// Rays traced, weighted by their usual time, without connections of path reuse. `ray_cost`: of a path's ray with its shading (ray_cost_of).
double path_work(const VariantTile& v, double ray_cost);
double ray_cost_of(const KernelContext& context);

// A tile in both ways.
struct VariantPair {
    VariantSums with, without;
};
// Ratios of with over without.
PilotFigures figures_of(std::span<const VariantPair> tiles);

} // namespace blush
