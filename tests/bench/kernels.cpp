// All kernels that can render a scene, on the same tiles in turn: the benefit of specialised code and wide registers.
#include "tests/bench/bench.h"

#include "core/parallel.h"
#include "render/compile/expand_area_lights.h"
#include "render/compile/kernel_speed.h"
#include "render/compile/render_scene.h"

#include <algorithm>

namespace blush::bench {
namespace {

std::vector<const Kernel*> able_kernels(Features needed) {
    std::vector<const Kernel*> kernels;
    for (const std::string_view isa : runnable_isas())
        for (const Kernel& kernel : kernels_of(isa))
            if (kernel.features.contains(needed)) kernels.push_back(&kernel);
    return kernels;
}

const KernelTimes& times_of(const Kernel& kernel, const std::vector<KernelTimes>& all) {
    return *std::ranges::find(all, &kernel, &KernelTimes::kernel);
}

Json measure(const BenchScene& scene, const Options& options) {
    const RenderSettings settings = rate_settings();
    RenderScene compiled;
    compiled.update(expand_area_lights(scene.scene), settings, full_plan(), Workers(1));
    const std::vector<TileJob> tiles = sample_tiles(settings, 7);
    const double paths = double(tiles.size()) * tiles.front().paths();
    const std::vector<KernelTimes> all = time_kernels(compiled, settings, able_kernels(compiled.features()), tiles, options.rounds);

    Json kernels;
    for (const KernelTimes& times : all) {
        const std::string name = std::string(times.kernel->isa) + "/" + std::string(times.kernel->name);
        kernels[name] = rounded(paths / median(times.core_seconds) / 1e6);
    }
    const Kernel& own = choose_kernel(compiled.features());
    const KernelSpeed speed = compare_kernels(times_of(own, all), times_of(kernels_of(own.isa).back(), all), paths);
    return {
        {"scene", scene.name()}, {"own", speed.own}, {"own_over_full", rounded(speed.ratio)}, {"million_paths_per_core_second", kernels}};
}

} // namespace

Json run_kernels(const Options& options) {
    Json result = Json::array();
    for (const BenchScene& scene : options.scenes)
        if (scene.ours) result.push_back(measure(scene, options));
    return result;
}

} // namespace blush::bench
