// Cost of the error estimate for an image of the window's size, relative to rendering one sample per pixel. CPU seconds of all
// cores, measured in turn.
#include "tests/bench/bench.h"

#include "render/renderer.h"

namespace blush::bench {
namespace {

Json measure(const BenchScene& scene, const Options& options) {
    Renderer renderer({.threads = options.threads, .planes = {}});
    renderer.update(scene.scene, window_settings());
    renderer.render(0, 1);
    std::vector<double> sample, estimate, shares;
    for (int round = 1; round <= options.rounds; ++round) {
        sample.push_back(cost_of([&] { renderer.render(round, 1); }).core_seconds);
        estimate.push_back(cost_of([&] { renderer.estimate_error(); }).core_seconds);
        shares.push_back(estimate.back() / sample.back());
    }
    return {{"scene", scene.name()},
            {"estimate_core_ms", rounded(1e3 * median(estimate))},
            {"one_sample_core_ms", rounded(1e3 * median(sample))},
            {"estimate_over_one_sample", rounded(median(shares))}};
}

} // namespace

Json run_estimate(const Options& options) {
    Json result = Json::array();
    for (const BenchScene& scene : options.scenes)
        if (scene.ours) result.push_back(measure(scene, options));
    return result;
}

} // namespace blush::bench
