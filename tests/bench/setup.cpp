// From a file to the first ray: seconds to import and to compile, and peak memory, including a film of the window's size.
#include "tests/bench/bench.h"
#include "tests/bench/machine.h"

#include "io/gltf/read/import.h"
#include "render/renderer.h"

#include <algorithm>

namespace blush::bench {
namespace {

Json measure(const BenchScene& scene, const Options& options) {
    std::vector<double> import_seconds, compile_seconds;
    double peak_mb = 0, tables_mb = 0;
    for (int round = 0; round < options.rounds; ++round) {
        const MemoryGrowth memory;
        auto begin = Clock::now();
        const Result<ImportedScene> imported = import_gltf(scene.file);
        import_seconds.push_back(seconds_since(begin));
        if (!imported) return {{"scene", scene.name()}, {"failed", imported.error().text()}};
        begin = Clock::now();
        Renderer renderer({.threads = options.threads, .planes = {}});
        renderer.update(imported->scene, window_settings());
        compile_seconds.push_back(seconds_since(begin));
        peak_mb = std::max(peak_mb, memory.peak_mb());
        tables_mb = renderer.info().memory_mb;
    }
    return {{"scene", scene.name()},
            {"import_seconds", rounded(median(import_seconds))},
            {"compile_seconds", rounded(median(compile_seconds))},
            {"compiled_mb", rounded(tables_mb)},
            {"peak_mb", rounded(peak_mb)}};
}

} // namespace

Json run_setup(const Options& options) {
    Json result = Json::array();
    for (const BenchScene& scene : options.scenes) result.push_back(measure(scene, options));
    return result;
}

} // namespace blush::bench
