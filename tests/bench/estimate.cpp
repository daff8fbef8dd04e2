// What the error estimate costs: resolving a picture of the window's size with it and without - a film of one sample has nothing to compare
// - beside the rendering of one sample per pixel. Seconds of all cores, in turns.
#include "tests/bench/bench.h"

#include "render/renderer.h"

namespace blush::bench {
namespace {

Json measure(const BenchScene& scene, const Options& options) {
    Renderer renderer({.threads = options.threads, .planes = {}});
    renderer.update(scene.scene, window_settings());
    Frame frame;
    const auto resolve_seconds = [&] { return cost_of([&] { renderer.resolve(frame); }).core_seconds; };
    std::vector<double> sample, estimate, shares;
    for (int round = 0; round < options.rounds; ++round) {
        renderer.clear();
        renderer.render(0, 1);
        renderer.resolve(frame); // memory that is made upon first use is there
        const double without = resolve_seconds();
        sample.push_back(cost_of([&] { renderer.render(1, 1); }).core_seconds);
        estimate.push_back(resolve_seconds() - without);
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
