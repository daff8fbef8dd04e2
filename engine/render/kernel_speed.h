// What specialised kernels are worth: the same tiles by several kernels in turns, so that a busy machine is fair to each.
#pragma once

#include "render/kernels/kernel.h"
#include "scene/render_settings.h"
#include "scene/scene.h"

#include <span>
#include <vector>

namespace blush {

class RenderScene;

// Every `stride`-th of the tiles that a renderer makes of eight samples of the image, which cuts it into squares of 16 pixels. A stride
// without common factors with the number of tiles in a row takes them from all over the image.
std::vector<TileJob> sample_tiles(const RenderSettings& settings, int stride);

struct KernelTimes {
    const Kernel* kernel;
    std::vector<double> core_seconds; // of the processor, for all tiles; one for each round
};
// `settings` as the scene was compiled with; every kernel must have the features that it needs. On one thread, this process's others idle.
std::vector<KernelTimes> time_kernels(const RenderScene& compiled, const RenderSettings& settings, std::span<const Kernel* const> kernels,
                                      std::span<const TileJob> tiles, int rounds);

// The kernel that a scene gets beside the one that can do everything, for the same instruction set.
struct KernelSpeed {
    std::string own, full;                              // "v4/lambert", "v4/full"
    double own_mpaths_per_s = 0, full_mpaths_per_s = 0; // million paths per second of one core, medians
    double ratio = 1;                                   // median over rounds of own / full
};
// Compiles the scene and takes a second or two, less for small images.
KernelSpeed measure_kernel_speed(const Scene& scene, const RenderSettings& settings);
// Of two entries of time_kernels() over so many paths.
KernelSpeed compare_kernels(const KernelTimes& own, const KernelTimes& full, double paths);

} // namespace blush
