// Measures the speed of specialised kernels: renders the same tiles
// with several kernels in turn, so that machine load affects all equally.
#pragma once

#include "render/kernels/kernel.h"
#include "scene/render_settings.h"
#include "scene/scene.h"

#include <span>
#include <vector>

namespace blush {

class RenderScene;

// Every `stride`-th tile of the image at eight samples, in squares of 16 pixels. A stride coprime to the number of tiles in a row
// spreads them over the image.
std::vector<TileJob> sample_tiles(const RenderSettings& settings, int stride);

struct KernelTimes {
    const Kernel* kernel;
    std::vector<double> core_seconds; // CPU seconds for all tiles, one entry per round
};
// `settings` as the scene was compiled with; every kernel must have the features that it needs. Single-threaded; other threads of
// the process should be idle.
std::vector<KernelTimes> time_kernels(const RenderScene& compiled, const RenderSettings& settings, std::span<const Kernel* const> kernels,
                                      std::span<const TileJob> tiles, int rounds);

// Speed of the scene's kernel relative to the full-featured one of the same instruction set.
struct KernelSpeed {
    std::string own, full;                              // "v4/lambert", "v4/full"
    double own_mpaths_per_s = 0, full_mpaths_per_s = 0; // million paths per second of one core, medians
    double ratio = 1;                                   // median over rounds of own / full
};
// Compiles the scene; takes a second or two, less for small images.
KernelSpeed measure_kernel_speed(const Scene& scene, const RenderSettings& settings);
// Compares two entries of time_kernels() over so many paths.
KernelSpeed compare_kernels(const KernelTimes& own, const KernelTimes& full, double paths);

} // namespace blush
