#include "render/pilots/light_path_pilot.h"

#include "render/film/edges/edge_samples.h"
#include "render/pilots/pilot_tiles.h"
#include "render/pilots/variant_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace blush {
namespace {

// Any; they only have to differ from each other and from those of images.
constexpr uint32_t light_seed = 0x11a7a000, camera_seed = 0x11a7a001;
constexpr int pilot_pixels = 1 << 14; // of the image that is measured,
constexpr int error_tile = 8;         // pixels along a side of the tiles whose mean relative errors refer to
constexpr int light_tiles = 16;       // of tile_capacity light paths
constexpr std::array<float, 7> shares{0.125f, 0.25f, 0.5f, 1, 2, 4, 8};
constexpr double least_ratio = 1e-9; // of densities: light that the camera cannot find at all

// Luminance by pixel.
struct Measured {
    int width, height;
    std::vector<double> mean, camera_variance;                 // of a sample
    std::array<std::vector<double>, shares.size() + 1> moment; // of light that light paths carry, for no light paths and for each share
    std::vector<double> alone;                                 // moment of light that light paths alone find, at a share of 1
    double camera_work = 0, light_work = 0, alone_work = 0;    // of a sample of each pixel, of as many light paths
};

Measured measured_image(int width, int height) {
    Measured m{width, height, {}, {}, {}, {}};
    const auto pixels = size_t(width) * size_t(height);
    m.mean.assign(pixels, 0);
    m.camera_variance.assign(pixels, 0);
    m.alone.assign(pixels, 0);
    for (auto& moments : m.moment) moments.assign(pixels, 0);
    return m;
}

void add_light_tile(const LightPathColumns& columns, double paths, Measured& m) {
    constexpr double emitted = double(light_tiles) * tile_capacity;
    for (const Splat& s : columns.splats)
        if (const double l = double(luminance(s.radiance)); std::isfinite(l)) m.mean[size_t(s.pixel)] += l * paths / emitted;
    for (const auto& moment : columns.moments) {
        const double squared = double(moment.amount) * double(moment.amount) * paths / emitted;
        if (!std::isfinite(squared) || moment.others == 0) continue; // add_alone_tile() has what they alone find
        const double others = std::max(double(moment.others), least_ratio);
        m.moment[0][size_t(moment.pixel)] += squared / others;
        for (size_t k = 0; k < shares.size(); ++k) m.moment[k + 1][size_t(moment.pixel)] += squared / (others + double(shares[k]));
    }
}

void add_alone_tile(const LightPathColumns& columns, double paths, Measured& m) {
    constexpr double emitted = double(light_tiles) * tile_capacity;
    for (const auto& moment : columns.moments)
        if (const double squared = double(moment.amount) * double(moment.amount); std::isfinite(squared))
            m.alone[size_t(moment.pixel)] += squared * paths / emitted;
}

// `refined`: what smooth edges replace in `v`; may be empty.
void add_camera_tile(const TileJob& tile, const VariantTile& v, const VariantTile& refined, Measured& m) {
    for (int y = 0; y < tile.height; ++y)
        for (int x = 0; x < tile.width; ++x) {
            const size_t k = 2 * (size_t(y) * size_t(tile.width) + size_t(x));
            const size_t pixel = size_t(tile.y + y) * size_t(m.width) + size_t(tile.x + x);
            const double a = luminance(v.means[k]), b = luminance(v.means[k + 1]);
            m.mean[pixel] += (a + b) / 2;
            const Vec3d noise =
                v.means[k] - v.means[k + 1] - (refined.means.empty() ? Vec3d{0, 0, 0} : refined.means[k] - refined.means[k + 1]);
            m.camera_variance[pixel] += luminance(noise) * luminance(noise) / 4 * pilot_samples;
        }
}

// Whether so few samples meet the rarest fireflies is chance: no pixel counts for more than all others.
void limit_largest(std::vector<double>& variances) {
    const auto largest = std::ranges::max_element(variances);
    const double largest_value = std::exchange(*largest, 0);
    *largest = std::min(largest_value, std::accumulate(variances.begin(), variances.end(), 0.0));
}

// Sums over the image, and over its tiles relative to their means.
struct Sums {
    double all = 0, relative = 0;
};
template <class Variance> Sums sums_of(const Measured& m, const Variance& variance) {
    Sums sums;
    for (int y0 = 0; y0 < m.height; y0 += error_tile)
        for (int x0 = 0; x0 < m.width; x0 += error_tile) {
            double sum = 0, count = 0, of_tile = 0;
            for (int y = y0; y < std::min(y0 + error_tile, m.height); ++y)
                for (int x = x0; x < std::min(x0 + error_tile, m.width); ++x) {
                    const size_t i = size_t(y) * size_t(m.width) + size_t(x);
                    sum += m.mean[i];
                    of_tile += variance(i);
                    ++count;
                }
            const double scale = 1 / (sum * sum / (count * count) + dark_squared);
            sums.all += of_tile;
            sums.relative += of_tile * scale;
        }
    return sums;
}

// Variances and work of one share over those without light paths. `k`: index of Measured::moment.
PilotFigures figures_of(const Measured& m, size_t k) {
    const auto sums_at = [&](size_t moment) { return sums_of(m, [&](size_t i) { return m.camera_variance[i] + m.moment[moment][i]; }); };
    const Sums with = sums_at(k), without = sums_at(0);
    const auto ratio = [](double x, double y) { return x > 0 && y > 0 ? x / y : 1.0; };
    const double mse = ratio(with.all, without.all), relmse = ratio(with.relative, without.relative);
    // Without the typical tile: fireflies of the camera's paths are known from light paths, and what is left of them decides.
    return {.mse = mse,
            .relmse = relmse,
            .typical = std::sqrt(mse * relmse),
            .work = k > 0 && m.camera_work > 0 ? 1 + double(shares[k - 1]) * m.light_work / m.camera_work : 1};
}

// The share of light paths that alone find their light with the smallest variance x work. `k`: as above, of the other light paths.
float share_alone(const Measured& m, size_t k) {
    float best = shares[0];
    double least = std::numeric_limits<double>::infinity();
    for (const float share : shares) {
        const Sums sums = sums_of(m, [&](size_t i) { return m.camera_variance[i] + m.moment[k][i] + m.alone[i] / double(share); });
        const double cost = std::sqrt(sums.all * sums.relative) * (m.camera_work + double(share) * m.alone_work);
        if (cost >= least) continue;
        least = cost;
        best = share;
    }
    return best;
}

// Calls add(columns) for each tile, in order; `work`: of `paths` light paths. False if the tiles are not wanted any more.
template <class Add> bool trace_light_tiles(const TileRunner& runner, KernelContext context, const Kernel& kernel,
                                            const LightPathEmission& emission, float paths, double& work, const Add& add) {
    if (emission.empty()) return true;
    constexpr int64_t all = int64_t(light_tiles) * tile_capacity;
    SceneTables tables = *context.scene;
    tables.emission = emission.tables(paths);
    context.scene = &tables;
    context.seed = light_seed;
    std::vector<std::unique_ptr<LightPathColumns>> columns(light_tiles);
    std::vector<double> works(light_tiles);
    if (!runner.for_each(light_tiles, [&](size_t i, TileScratch& tile) {
            tile.light_paths = std::make_unique<LightPathColumns>();
            tile.light_paths->measures = true;
            tile.bounce_rays = tile.shadow_rays = 0;
            trace_light_path_tile(context, kernel, emission, {0, all, int64_t(i) * tile_capacity, tile_capacity}, tile);
            works[i] = double(std::exchange(tile.bounce_rays, 0)) + shadow_ray_cost * double(std::exchange(tile.shadow_rays, 0));
            columns[i] = std::move(tile.light_paths);
        }))
        return false;
    for (size_t i = 0; i < light_tiles; ++i) {
        add(*columns[i]);
        work += works[i] * double(paths) / double(all);
    }
    return true;
}

} // namespace

std::optional<LightPathPilot> measure_light_paths(KernelContext context, const CasterSphere& scene_sphere, const Kernel& kernel,
                                                  const std::optional<RefinedEmission>& refined, const Workers& workers,
                                                  std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted) {
    LightPathPilot pilot{.emission = LightPathEmission(*context.scene, scene_sphere),
                         .zero_size = LightPathEmission::of_zero_size_lights(*context.scene, scene_sphere)};
    if (pilot.emission.empty()) return pilot;
    const PilotImage image = pilot_image(context.settings, pilot_pixels);
    const int width = image.width, height = image.height;
    const auto paths = float(width) * float(height);
    context.settings.reuse = {};
    context.settings.max_bounces = pilot_max_bounces;
    context.settings.width = float(width);
    context.settings.height = float(height);
    Measured m = measured_image(width, height);

    const TileRunner runner{workers, scratch, wanted};
    const auto trace = [&](const LightPathEmission& emission, double& work, auto add_tile) {
        return trace_light_tiles(runner, context, kernel, emission, paths, work,
                                 [&](const LightPathColumns& c) { add_tile(c, double(paths), m); });
    };
    if (!trace(pilot.emission, m.light_work, add_light_tile) || !trace(pilot.zero_size, m.alone_work, add_alone_tile)) return std::nullopt;
    SceneTables tables = *context.scene;
    tables.emission = pilot.emission.tables(paths);
    context.scene = &tables;
    context.seed = camera_seed;
    const std::vector<TileJob>& tiles = image.tiles;
    SceneTables of_emission;
    KernelContext emission_context = context;
    if (refined) restrict_to_emission(emission_context, of_emission, refined->longest_chain);
    std::vector<VariantTile> variants(tiles.size()), emissions(tiles.size());
    const auto render_tile = [&](size_t i, TileScratch& tile) {
        variants[i] = render_variant(context, kernel, tiles[i], tile);
        if (refined) emissions[i] = render_variant(emission_context, refined->kernel, tiles[i], tile);
    };
    if (!runner.for_each(tiles.size(), render_tile)) return std::nullopt;
    for (size_t i = 0; i < tiles.size(); ++i) {
        add_camera_tile(tiles[i], variants[i], emissions[i], m);
        m.camera_work += path_work(variants[i], 1) / pilot_samples;
    }
    limit_largest(m.camera_variance);
    pilot.work = m.light_work / double(paths);
    pilot.zero_size_work = m.alone_work / double(paths);
    size_t chosen = 0;
    if (std::ranges::any_of(m.moment[0], [](double moment) { return moment > 0; })) {
        pilot.figures = figures_of(m, 1);
        double least = 1;
        for (size_t k = 1; k <= shares.size(); ++k) {
            const PilotFigures figures = figures_of(m, k);
            if (figures.cost() >= least) continue;
            least = figures.cost();
            chosen = k;
            pilot.share = shares[k - 1];
            pilot.figures = figures;
        }
    }
    if (!pilot.zero_size.empty()) pilot.zero_size_share = share_alone(m, chosen);
    return pilot;
}

} // namespace blush
