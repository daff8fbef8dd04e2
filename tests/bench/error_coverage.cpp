// Coverage of the true error by the error estimate's 95 % intervals, by scene and samples per pixel, for the plain path tracer
// and the recommended settings. The reference is the mean of renders with other seeds and many times the samples.
#include "tests/support/error_coverage.h"
#include "tests/bench/bench.h"

#include "render/renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace blush::bench {
namespace {

constexpr int64_t counts[]{2, 3, 4, 8, 16, 64};

RenderSettings coverage_settings() {
    RenderSettings settings;
    settings.width = 64;
    settings.height = 40;
    settings.spp = 64;
    return settings;
}

test::Truth truth_of(Renderer& renderer, const Scene& scene, int renders) {
    RenderSettings settings = coverage_settings();
    settings.smooth_edges = true; // so that the reference meets highlights as often as the best image
    const size_t values = 3 * size_t(settings.width) * size_t(settings.height);
    std::vector<double> sums(values), squares(values);
    for (int i = 0; i < renders; ++i) {
        settings.seed = 100000 + uint32_t(i);
        renderer.update(scene, settings);
        renderer.render(0, settings.spp);
        const Frame frame = renderer.resolve();
        for (size_t v = 0; v < values; ++v) {
            const double x = double(frame.rgba[4 * (v / 3) + v % 3]);
            sums[v] += x;
            squares[v] += x * x;
        }
    }
    test::Truth truth;
    const double n = renders;
    const auto mean = [&](size_t v) { return sums[v] / n; };
    const auto variance = [&](size_t v) { return std::max(0.0, squares[v] / n - mean(v) * mean(v)) / (n - 1); };
    for (size_t v = 0; v < values; v += 3) {
        truth.mean.push_back({mean(v), mean(v + 1), mean(v + 2)});
        truth.variance.push_back({variance(v), variance(v + 1), variance(v + 2)});
    }
    return truth;
}

Json figures_of(const test::Coverage& c) {
    const auto share = [](int64_t part, int64_t whole) { return whole > 0 ? Json(rounded(double(part) / double(whole))) : Json(); };
    const auto mean_factor = [&](double sum) { return c.known > 0 ? Json(rounded(std::exp(sum / double(c.known)))) : Json(); };
    return {{"runs", c.runs},
            {"relmse", {{"known", share(c.known, c.runs)}, {"covered", share(c.covered, c.known)}}},
            {"rmse", {{"known", share(c.rmse_known, c.runs)}, {"covered", share(c.rmse_covered, c.rmse_known)}}},
            {"estimate_over_truth", mean_factor(c.log_ratio)},
            {"high_over_low", mean_factor(c.log_width)}};
}

} // namespace

Json run_error_coverage(const Options& options) {
    const int runs = 20 * options.rounds;
    RenderSettings recommended = coverage_settings();
    recommended.adaptive = recommended_settings().adaptive;
    recommended.reuse = recommended_settings().reuse;
    recommended.smooth_edges = recommended_settings().smooth_edges;
    const std::pair<const char*, RenderSettings> kinds[]{{"plain", coverage_settings()}, {"recommended", recommended}};
    Json json;
    test::Coverage all[std::size(kinds)];
    for (const BenchScene& scene : options.scenes) {
        Renderer renderer({.threads = options.threads, .planes = {}});
        const test::Truth truth = truth_of(renderer, scene.scene, 2 * runs);
        for (size_t kind = 0; kind < std::size(kinds); ++kind) {
            auto [name, settings] = kinds[kind];
            std::vector<test::Coverage> by_count(std::size(counts));
            for (int run = 0; run < runs; ++run) {
                settings.seed = uint32_t(run);
                renderer.update(scene.scene, settings);
                renderer.clear();
                int64_t samples = 0;
                for (size_t i = 0; i < std::size(counts); ++i) {
                    renderer.render(samples, counts[i] - samples);
                    samples = counts[i];
                    const Frame frame = renderer.resolve();
                    by_count[i].add(frame.error, test::true_error(frame, truth));
                }
            }
            for (size_t i = 0; i < std::size(counts); ++i) {
                json[name][scene.name()][std::to_string(counts[i]) + " spp"] = figures_of(by_count[i]);
                all[kind].merge(by_count[i]);
            }
        }
    }
    for (size_t kind = 0; kind < std::size(kinds); ++kind) json[kinds[kind].first]["all"] = figures_of(all[kind]);
    return json;
}

} // namespace blush::bench
