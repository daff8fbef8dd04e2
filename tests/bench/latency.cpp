// Latency from an edit to the first image that shows it, in the window's session while it is refining the previous scene.
#include "tests/bench/bench.h"
#include "tests/bench/edits.h"
#include "tests/bench/latency_probe.h"

#include <random>

namespace blush::bench {
namespace {

Json measure(const BenchScene& scene, const Options& options) {
    const RenderSettings settings = window_settings();
    LatencyProbe probe(options.threads);
    std::mt19937 random(1);
    const std::optional<Response> opened = probe.measure(scene.scene, settings);
    if (!opened) return {{"scene", scene.name()}, {"failed", "the session gave no image"}};

    Json result{{"scene", scene.name()}, {"threads", options.threads}, {"opened", figures_of({*opened})}};
    for (const EditKind& kind : edits_of(scene.scene)) {
        Scene edited = scene.scene;
        std::vector<Response> responses;
        for (int step = 1; step <= options.edits; ++step) {
            render_for_a_while(random);
            kind.apply(edited, step);
            const std::optional<Response> response = probe.measure(edited, settings);
            if (!response) return {{"scene", scene.name()}, {"failed", kind.name}};
            responses.push_back(*response);
        }
        result[kind.name] = figures_of(responses);
    }
    return result;
}

} // namespace

Json run_latency(const Options& options) {
    Json result = Json::array();
    for (const BenchScene& scene : options.scenes) result.push_back(measure(scene, options));
    return result;
}

} // namespace blush::bench
