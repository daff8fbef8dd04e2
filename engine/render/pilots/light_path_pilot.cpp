#include "render/pilots/light_path_pilot.h"

#include "render/pilots/pilot_tiles.h"
#include "render/pilots/variant_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
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
    double camera_work = 0, light_work = 0;                    // of a sample of each pixel, of as many light paths
};

Measured measured_image(int width, int height) {
    Measured m{width, height, {}, {}, {}};
    const auto pixels = size_t(width) * size_t(height);
    m.mean.assign(pixels, 0);
    m.camera_variance.assign(pixels, 0);
    for (auto& moments : m.moment) moments.assign(pixels, 0);
    return m;
}

void add_light_tile(const LightPathColumns& columns, double paths, Measured& m) {
    constexpr double emitted = double(light_tiles) * tile_capacity;
    for (const Splat& s : columns.splats)
        if (const double l = double(luminance(s.radiance)); std::isfinite(l)) m.mean[size_t(s.pixel)] += l * paths / emitted;
    for (const auto& moment : columns.moments) {
        const double squared = double(moment.amount) * double(moment.amount) * paths / emitted;
        if (!std::isfinite(squared)) continue;
        const double others = std::max(double(moment.others), least_ratio);
        m.moment[0][size_t(moment.pixel)] += squared / others;
        for (size_t k = 0; k < shares.size(); ++k) m.moment[k + 1][size_t(moment.pixel)] += squared / (others + double(shares[k]));
    }
}

void add_camera_tile(const TileJob& tile, const VariantTile& v, Measured& m) {
    for (int y = 0; y < tile.height; ++y)
        for (int x = 0; x < tile.width; ++x) {
            const size_t k = 2 * (size_t(y) * size_t(tile.width) + size_t(x));
            const size_t pixel = size_t(tile.y + y) * size_t(m.width) + size_t(tile.x + x);
            const double a = luminance(v.means[k]), b = luminance(v.means[k + 1]);
            m.mean[pixel] += (a + b) / 2;
            m.camera_variance[pixel] += (a - b) * (a - b) / 4 * pilot_samples;
        }
}

// Variances and work of one share over those without light paths. `k`: index of Measured::moment.
PilotFigures figures_of(const Measured& m, size_t k) {
    double with = 0, without = 0, relative_with = 0, relative_without = 0;
    for (int y0 = 0; y0 < m.height; y0 += error_tile)
        for (int x0 = 0; x0 < m.width; x0 += error_tile) {
            double sum = 0, count = 0, a = 0, b = 0;
            for (int y = y0; y < std::min(y0 + error_tile, m.height); ++y)
                for (int x = x0; x < std::min(x0 + error_tile, m.width); ++x) {
                    const size_t i = size_t(y) * size_t(m.width) + size_t(x);
                    sum += m.mean[i];
                    a += m.camera_variance[i] + m.moment[k][i];
                    b += m.camera_variance[i] + m.moment[0][i];
                    ++count;
                }
            const double scale = 1 / (sum * sum / (count * count) + dark_squared);
            with += a;
            without += b;
            relative_with += a * scale;
            relative_without += b * scale;
        }
    const auto ratio = [](double x, double y) { return x > 0 && y > 0 ? x / y : 1.0; };
    const double mse = ratio(with, without), relmse = ratio(relative_with, relative_without);
    // Without the typical tile: fireflies of the camera's paths are known from light paths, and what is left of them decides.
    return {.mse = mse,
            .relmse = relmse,
            .typical = std::sqrt(mse * relmse),
            .work = k > 0 && m.camera_work > 0 ? 1 + double(shares[k - 1]) * m.light_work / m.camera_work : 1};
}

} // namespace

std::optional<LightPathPilot> measure_light_paths(KernelContext context, const CasterSphere& scene_sphere, const Kernel& kernel,
                                                  const Workers& workers, std::vector<std::unique_ptr<TileScratch>>& scratch,
                                                  const std::function<bool()>& wanted) {
    LightPathPilot pilot{LightPathEmission(*context.scene, scene_sphere), 0, {}};
    if (pilot.emission.empty()) return pilot;
    const PilotImage image = pilot_image(context.settings, pilot_pixels);
    const int width = image.width, height = image.height;
    const auto paths = float(width) * float(height);
    SceneTables tables = *context.scene;
    tables.emission = pilot.emission.tables(paths);
    context.scene = &tables;
    context.settings.reuse = {};
    context.settings.max_bounces = pilot_max_bounces;
    context.settings.width = float(width);
    context.settings.height = float(height);
    Measured m = measured_image(width, height);

    const auto for_each_tile = [&](size_t count, const auto& task) {
        return workers.for_each(int64_t(count), wanted, [&](int64_t i, unsigned worker) {
            if (!scratch[worker]) scratch[worker] = std::make_unique<TileScratch>();
            task(size_t(i), *scratch[worker]);
        });
    };
    context.seed = light_seed;
    std::vector<std::unique_ptr<LightPathColumns>> of_light_tile(light_tiles);
    std::vector<double> works(light_tiles);
    if (!for_each_tile(light_tiles, [&](size_t i, TileScratch& tile) {
            tile.light_paths = std::make_unique<LightPathColumns>();
            tile.light_paths->measures = true;
            tile.bounce_rays = tile.shadow_rays = 0;
            trace_light_path_tile(context, kernel, pilot.emission,
                                  {0, int64_t(light_tiles) * tile_capacity, int64_t(i) * tile_capacity, tile_capacity}, tile);
            works[i] = double(std::exchange(tile.bounce_rays, 0)) + shadow_ray_cost * double(std::exchange(tile.shadow_rays, 0));
            of_light_tile[i] = std::move(tile.light_paths);
        }))
        return std::nullopt;
    for (int i = 0; i < light_tiles; ++i) {
        add_light_tile(*of_light_tile[size_t(i)], double(paths), m);
        m.light_work += works[size_t(i)] * double(paths) / (double(light_tiles) * tile_capacity);
    }
    context.seed = camera_seed;
    const std::vector<TileJob>& tiles = image.tiles;
    std::vector<VariantTile> variants(tiles.size());
    if (!for_each_tile(tiles.size(), [&](size_t i, TileScratch& tile) { variants[i] = render_variant(context, kernel, tiles[i], tile); }))
        return std::nullopt;
    for (size_t i = 0; i < tiles.size(); ++i) {
        add_camera_tile(tiles[i], variants[i], m);
        m.camera_work += path_work(variants[i], 1) / pilot_samples;
    }
    if (pilot.emission.has_zero_size_lights()) pilot.share = shares[0]; // at least
    if (!std::ranges::any_of(m.moment[0], [](double moment) { return moment > 0; })) return pilot;
    pilot.figures = figures_of(m, 1);
    double least = 1;
    for (size_t k = 1; k <= shares.size(); ++k) {
        const PilotFigures figures = figures_of(m, k);
        if (figures.cost() >= least) continue;
        least = figures.cost();
        pilot.share = shares[k - 1];
        pilot.figures = figures;
    }
    return pilot;
}

} // namespace blush
