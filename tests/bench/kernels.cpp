// Every kernel that can render a scene, on the same tiles in turns: what specialised code and wide registers are worth.
#include "tests/bench/bench.h"
#include "tests/bench/tiles.h"

#include "core/parallel.h"
#include "render/lowering.h"
#include "render/render_scene.h"
#include "render/settings_for_kernels.h"

namespace blush::bench {
namespace {

struct Entry {
    const Kernel* kernel;
    std::vector<double> core_seconds; // by round
};

std::vector<Entry> able_kernels(Features needed) {
    std::vector<Entry> entries;
    for (const std::string_view isa : runnable_isas())
        for (const Kernel& kernel : kernels_of(isa))
            if (kernel.features.contains(needed)) entries.push_back({&kernel, {}});
    return entries;
}

Json measure(const BenchScene& scene, const Options& options) {
    const Workers workers(1);
    const RenderSettings settings = rate_settings();
    RenderScene compiled;
    compiled.update(lower_area_lights(scene.scene), settings, full_plan(), workers);
    const KernelContext context{&compiled.tables(), &compiled.accel(), settings_for_kernels(settings, settings.width, settings.height),
                                settings.seed};
    const std::vector<TileJob> tiles = tiles_of(settings, 7);
    const auto scratch = std::make_unique<TileScratch>();

    std::vector<Entry> entries = able_kernels(compiled.features());
    for (int round = 0; round < options.rounds; ++round)
        for (Entry& entry : entries)
            entry.core_seconds.push_back(cost_of([&] {
                                             workers.for_each(int64_t(tiles.size()), {}, [&](int64_t i, unsigned) {
                                                 entry.kernel->render(context, tiles[size_t(i)], *scratch);
                                             });
                                         }).core_seconds);

    Json kernels;
    for (const Entry& entry : entries) {
        const double paths = double(tiles.size()) * tiles.front().paths();
        const std::string name = std::string(entry.kernel->isa) + "/" + std::string(entry.kernel->name);
        kernels[name] = rounded(paths / median(entry.core_seconds) / 1e6);
    }
    return {{"scene", scene.name()}, {"million_paths_per_core_second", kernels}};
}

} // namespace

Json run_kernels(const Options& options) {
    Json result = Json::array();
    for (const BenchScene& scene : options.scenes)
        if (scene.ours) result.push_back(measure(scene, options));
    return result;
}

} // namespace blush::bench
