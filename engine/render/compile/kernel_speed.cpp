#include "render/compile/kernel_speed.h"

#include "core/parallel.h"
#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/integrator/kernel_settings.h"

#include <algorithm>
#include <ctime>

namespace blush {
namespace {

std::string full_name(const Kernel& kernel) { return std::string(kernel.isa) + "/" + std::string(kernel.name); }

double median(std::vector<double> values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace

std::vector<TileJob> sample_tiles(const RenderSettings& settings, int stride) {
    constexpr int side = 16;
    std::vector<TileJob> tiles;
    int index = 0;
    for (int y = 0; y + side <= settings.height; y += side)
        for (int x = 0; x + side <= settings.width; x += side)
            if (index++ % stride == 0) tiles.push_back({.x = x, .y = y, .width = side, .height = side, .first_sample = 0, .samples = 8});
    return tiles;
}

std::vector<KernelTimes> time_kernels(const RenderScene& compiled, const RenderSettings& settings, std::span<const Kernel* const> kernels,
                                      std::span<const TileJob> tiles, int rounds) {
    const Workers workers(1);
    const auto scratch = std::make_unique<TileScratch>();
    const KernelContext context{&compiled.tables(), &compiled.accel(), kernel_settings(settings, settings.width, settings.height),
                                settings.seed};
    std::vector<KernelTimes> times;
    for (const Kernel* kernel : kernels) times.push_back({kernel, {}});
    for (int round = 0; round < rounds; ++round)
        for (KernelTimes& entry : times) {
            const std::clock_t begin = std::clock();
            workers.for_each(int64_t(tiles.size()), {},
                             [&](int64_t i, unsigned) { entry.kernel->render(context, tiles[size_t(i)], *scratch); });
            entry.core_seconds.push_back(double(std::clock() - begin) / CLOCKS_PER_SEC);
        }
    return times;
}

KernelSpeed compare_kernels(const KernelTimes& own, const KernelTimes& full, double paths) {
    std::vector<double> ratios;
    for (size_t i = 0; i < own.core_seconds.size(); ++i) ratios.push_back(full.core_seconds[i] / std::max(own.core_seconds[i], 1e-9));
    return {full_name(*own.kernel), full_name(*full.kernel), paths / std::max(median(own.core_seconds), 1e-9) * 1e-6,
            paths / std::max(median(full.core_seconds), 1e-9) * 1e-6, median(ratios)};
}

KernelSpeed measure_kernel_speed(const Scene& scene, const RenderSettings& settings) {
    constexpr int rounds = 9;
    constexpr size_t max_tiles = 60;
    RenderScene compiled;
    compiled.update(expand_area_lights(scene), settings, full_plan(), Workers(0));
    const Kernel& own = choose_kernel(compiled.features());
    const Kernel& full = kernels_of(own.isa).back();

    std::vector<TileJob> tiles = sample_tiles(settings, 1);
    if (tiles.empty()) tiles = {{.width = std::min(settings.width, 64), .height = std::min(settings.height, 64)}};
    if (const size_t stride = tiles.size() / max_tiles | 1; stride > 1) tiles = sample_tiles(settings, int(stride));
    const Kernel* const kernels[] = {&own, &full};
    const std::vector<KernelTimes> times = time_kernels(compiled, settings, kernels, tiles, rounds);
    double paths = 0;
    for (const TileJob& tile : tiles) paths += tile.paths();
    return compare_kernels(times[0], times[1], paths);
}

} // namespace blush
