#include "app/commands/converge/run.h"

#include "measure/convergence/convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>

namespace blush {
namespace {

constexpr double slice_seconds = 0.1;
constexpr int explaining_rounds = 24;

// The renderer of one variant in one repeat.
struct Runner {
    std::unique_ptr<Renderer> renderer;
    double seconds = 0;
    int64_t samples = 0;
    DoublingTimes looks;
    bool done = false;

    void restart(const Scene& scene, RenderSettings settings, uint32_t seed) {
        settings.seed = seed;
        renderer->update(scene, settings);
        // Warm-up: allocations on first use are not part of the time. What a biased integrator prepares is, since clear() discards it.
        renderer->render(0, 1);
        renderer->clear();
        seconds = 0;
        samples = 0;
        looks = {};
        done = false;
    }
    // At most doubles the samples, so that every power of two is measured.
    int64_t next_count(const ConvergeInput& input) const {
        if (samples == 0) return 1;
        const double fitting = slice_seconds * double(samples) / std::max(seconds, 1e-9);
        int64_t count = std::max<int64_t>(1, std::min(samples, int64_t(std::min(fitting, 1e9))));
        if (input.spp > 0) count = std::min(count, input.spp - samples);
        return count;
    }
    void take_turn(const ConvergeInput& input) {
        const int64_t count = next_count(input);
        const auto begin = std::chrono::steady_clock::now();
        renderer->render(samples, count);
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        samples += count;
        done = (input.spp > 0 && samples >= input.spp) || (input.seconds > 0 && seconds >= input.seconds);
    }
    double fraction(const ConvergeInput& input) const {
        if (done) return 1;
        double f = 0;
        if (input.spp > 0) f = double(samples) / double(input.spp);
        if (input.seconds > 0) f = std::max(f, seconds / input.seconds);
        return std::min(f, 1.0);
    }
};

MeasuredPoint measured_point(const Runner& runner, int repeat, const MeasuredImage& reference, double reference_mse) {
    MeasuredPoint p{repeat, runner.seconds, runner.samples, {}, repeat == 0, false};
    const Frame frame = runner.renderer->resolve();
    RgbImage image{frame.width, frame.height, {}};
    for (size_t i = 0; i < frame.rgba.size(); i += 4) image.pixels.push_back({frame.rgba[i], frame.rgba[i + 1], frame.rgba[i + 2]});
    // Sizes agree, and films contain only finite values.
    if (const Result<Metrics> metrics = compare(image, reference.image, Encoding::scene_linear, p.has_flip)) p.metrics = *metrics;
    p.reference_clearly_better = clearly_better(reference_mse, p.metrics.mse);
    return p;
}

PowerFit fit(const std::vector<MeasuredPoint>& points, double (*x_of)(const MeasuredPoint&)) {
    std::vector<double> x, y;
    for (const MeasuredPoint& p : points) {
        if (!p.reference_clearly_better) continue;
        x.push_back(x_of(p));
        y.push_back(p.metrics.rmse);
    }
    return fit_power(x, y);
}

Interval efficiency_of(const std::vector<MeasuredPoint>& points) {
    std::vector<double> last;
    for (size_t i = 0; i < points.size(); ++i) {
        const bool ends_repeat = i + 1 == points.size() || points[i + 1].repeat != points[i].repeat;
        const double work = points[i].metrics.mse * points[i].seconds;
        if (ends_repeat && work > 0) last.push_back(1 / work);
    }
    return mean_interval(last);
}

void conclude(VariantResult& v, const MeasuredImage& reference) {
    v.over_seconds = fit(v.points, [](const MeasuredPoint& p) { return p.seconds; });
    v.over_spp = fit(v.points, [](const MeasuredPoint& p) { return double(p.spp); });
    v.efficiency = efficiency_of(v.points);
    v.bias = test_bias(v.mean, reference);
}

// Renders once more at a low resolution, with the same random numbers but without roulette and limit: the difference per bounce
// is the bias.
std::vector<RouletteBias> explain(const ConvergeInput& input, const RenderSettings& settings, const std::atomic<bool>& interrupted) {
    RouletteComparison lab({.threads = input.threads, .low_priority = false, .planes = {}});
    lab.begin(*input.scene, settings);
    for (int round = 0; round < explaining_rounds && !interrupted; ++round) lab.round([&] { return !interrupted; });
    const RouletteReport& report = lab.report();
    if (!report.biased()) return {};
    return {report.bias.begin() + 1, report.bias.end()}; // without the whole image
}

} // namespace

std::vector<uint32_t> seeds_of(const ConvergeInput& input) {
    std::vector<uint32_t> seeds;
    for (int i = 0; i < input.repeats; ++i) seeds.push_back(input.seed + uint32_t(i));
    return seeds;
}

ConvergeResult run_converge(const ConvergeInput& input, const MeasuredImage& reference, const std::atomic<bool>& interrupted,
                            const ConvergeProgress& progress) {
    ConvergeResult result;
    std::vector<Runner> runners(input.variants.size());
    for (const Variant& v : input.variants) result.variants.push_back({v, {}, {}, {}, {}, {}, {}, {}});
    for (size_t v = 0; v < runners.size(); ++v)
        runners[v].renderer = std::make_unique<Renderer>(
            RendererOptions{.threads = input.threads, .low_priority = false, .planes = {}, .integrator = input.variants[v].integrator});
    const double reference_mse = mean_square_error(reference);

    for (int repeat = 0; repeat < input.repeats && !interrupted; ++repeat) {
        for (size_t v = 0; v < runners.size(); ++v)
            runners[v].restart(*input.scene, input.variants[v].settings, input.seed + uint32_t(repeat));
        result.kernel = runners.front().renderer->info().kernel;
        while (!interrupted) {
            std::vector<double> clocks;
            double sum = 0;
            for (const Runner& r : runners) {
                clocks.push_back(r.done ? -1 : r.seconds);
                sum += r.fraction(input);
            }
            progress((repeat + sum / double(runners.size())) / input.repeats, fmt::format("repeat {} of {}", repeat + 1, input.repeats));
            const int turn = next_variant(clocks);
            if (turn < 0) break;
            Runner& runner = runners[size_t(turn)];
            runner.take_turn(input);
            if (runner.looks.due(runner.seconds) || runner.done)
                result.variants[size_t(turn)].points.push_back(measured_point(runner, repeat, reference, reference_mse));
        }
        for (size_t v = 0; v < runners.size(); ++v)
            if (runners[v].samples >= 2) result.variants[v].mean = merged(result.variants[v].mean, measured_image(*runners[v].renderer));
    }
    result.partial = interrupted;
    for (VariantResult& v : result.variants) {
        conclude(v, reference);
        const bool path_traced = v.variant.integrator.kind == ComparisonIntegrator::Kind::none;
        if (v.bias.biased && input.whole_paths && path_traced) v.bias_by_bounce = explain(input, v.variant.settings, interrupted);
    }
    return result;
}

} // namespace blush
