#include "measure/lab/roulette_comparison.h"

#include "core/math.h"
#include "measure/lab/lab_settings.h"
#include "measure/statistics/bounce_energy.h"
#include "measure/statistics/significance.h"
#include "render/roulette/adjoint_choice.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

constexpr int bounce_planes = 12;
constexpr double false_alarm = 1e-3;
constexpr int64_t min_bias_rounds = 8; // before bias is reported
constexpr int batches = 8;             // batches of rounds, for the standard error of the gain

double luminance_at(const Frame& f, size_t pixel) {
    return luminance(Vec3d{double(f.rgba[4 * pixel]), double(f.rgba[4 * pixel + 1]), double(f.rgba[4 * pixel + 2])});
}

// All rounds of one side in a batch.
struct Batch {
    std::vector<Trials> pixels; // luminance
    double seconds = 0;
    // Mean over pixels of the variance between rounds, times time: inverse efficiency up to the samples per round.
    double cost() const { return variance() * seconds / double(std::max<int64_t>(1, pixels.empty() ? 0 : pixels[0].count())); }
    double variance() const {
        double sum = 0;
        for (const Trials& t : pixels) sum += t.variance();
        return pixels.empty() ? 0 : sum / double(pixels.size());
    }
};

struct Side {
    std::unique_ptr<Renderer> renderer;
    RenderSettings settings;
    Frame frame; // last round
    std::vector<PathCounts> counts;
    RayCounts rays;
    double seconds = 0;
    std::array<Batch, batches> by_batch;
    Batch whole;

    void begin(const RendererOptions& options, const RenderSettings& s) {
        if (!renderer) {
            RendererOptions own = options;
            own.planes = {.bounces = bounce_planes, .roulette = true};
            renderer = std::make_unique<Renderer>(own);
        }
        settings = s;
        counts.assign(max_counted_bounces, {});
        rays = {};
        seconds = 0;
        by_batch = {};
        whole = {};
    }
    // Samples [first, first + spp). Without the time of pilots, which an image needs once.
    bool render(const Scene& scene, int64_t round, int64_t first, int spp, const std::function<bool()>& wanted) {
        settings.seed = uint32_t(round);
        renderer->update(scene, settings);
        renderer->clear();
        if (first > 0 && !renderer->decide(wanted)) return false;
        const auto begin = std::chrono::steady_clock::now();
        if (!renderer->render(first, spp, wanted)) return false;
        const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        renderer->resolve(frame);
        seconds += took;
        rays = {rays.camera + frame.rays.camera, rays.bounce + frame.rays.bounce, rays.shadow + frame.rays.shadow};
        for (size_t k = 0; k < counts.size(); ++k) counts[k] += frame.path_counts[k];
        for (Batch* batch : {&whole, &by_batch[size_t(round % batches)]}) {
            batch->pixels.resize(frame.rgba.size() / 4);
            for (size_t i = 0; i < batch->pixels.size(); ++i) batch->pixels[i].add(luminance_at(frame, i));
            batch->seconds += took;
        }
        return true;
    }
    RouletteSide figures(int spp) const {
        RouletteSide f;
        const double paths = double(std::max<int64_t>(1, rays.camera));
        f.path_length = double(rays.camera + rays.bounce) / paths;
        f.rays_per_path = double(rays.total()) / paths;
        f.path_seconds = seconds / paths;
        f.variance = whole.variance() * spp;
        f.efficiency = f.variance > 0 ? 1 / (f.variance * f.path_seconds) : 0;
        for (const PathCounts& c : counts) {
            if (c.alive == 0) break;
            f.alive.push_back(double(c.alive) / paths);
            f.survival.push_back(c.rr_applied > 0 ? double(c.survived) / double(c.rr_applied) : -1);
        }
        return f;
    }
};

RenderSettings without_roulette(RenderSettings settings) {
    settings.roulette.rule = Roulette::Rule::off;
    settings.max_bounces = unlimited_bounces;
    return settings;
}

} // namespace

struct RouletteComparison::State {
    RendererOptions options;
    Scene scene;
    Side rule, none;
    std::array<Trials, 1 + bounce_planes> differences, levels; // luminance: whole image, then by bounce
    RouletteReport report;

    void compare_means() {
        const std::vector<PlaneEnergy> with = bounce_energy(rule.frame), without = bounce_energy(none.frame);
        double whole_with = 0, whole_without = 0;
        report.bias.resize(1 + bounce_planes);
        report.bias[0].name = "whole image";
        for (size_t k = 0; k < with.size(); ++k) {
            const double a = luminance(with[k].mean), b = luminance(without[k].mean);
            whole_with += a;
            whole_without += b;
            differences[k + 1].add(a - b);
            levels[k + 1].add(b);
            report.bias[k + 1].name = fmt::format("bounce {}", with[k].name);
        }
        differences[0].add(whole_with - whole_without);
        levels[0].add(whole_without);
        const double whole = levels[0].mean(), threshold = significant_deviate(int(differences.size()), false_alarm);
        for (size_t i = 0; whole > 0 && i < differences.size(); ++i) {
            RouletteBias& bias = report.bias[i];
            bias.share = levels[i].mean() / whole;
            bias.difference = differences[i].mean() / whole;
            bias.error = differences[i].error() / whole;
            // Without variance (a limit removes all light of a bounce) any difference is significant.
            const double z = normal_deviate(bias.difference / bias.error, double(report.rounds - 1));
            bias.significant = report.rounds >= min_bias_rounds && (bias.error > 0 ? std::abs(z) > threshold : bias.difference != 0);
        }
    }

    void measure_gain() {
        Trials gains; // logarithms, so that a ratio and its inverse are symmetric
        for (int i = 0; i < batches; ++i) {
            const double with = rule.by_batch[size_t(i)].cost(), without = none.by_batch[size_t(i)].cost();
            if (report.rounds >= 2 * batches && with > 0 && without > 0) gains.add(std::log(without / with));
        }
        report.efficiency_gain = gains.count() == batches ? std::exp(gains.mean()) : 0;
        report.gain_error = report.efficiency_gain * gains.error();
    }
};

bool RouletteReport::biased() const { return std::ranges::any_of(bias, &RouletteBias::significant); }

RouletteComparison::RouletteComparison(const RendererOptions& options) : state_(std::make_unique<State>()) { state_->options = options; }
RouletteComparison::~RouletteComparison() = default;

void RouletteComparison::begin(const Scene& scene, const RenderSettings& settings, int longest, int spp) {
    State& s = *state_;
    const RenderSettings small = lab_settings(settings, longest);
    s.scene = scene;
    s.rule.begin(s.options, small);
    s.none.begin(s.options, without_roulette(small));
    s.differences = s.levels = {};
    s.report = {};
    s.report.width = small.width;
    s.report.height = small.height;
    s.report.spp = spp;
}

bool RouletteComparison::round(const std::function<bool()>& wanted) {
    State& s = *state_;
    Side* const turns[2] = {&s.rule, &s.none};
    const size_t first = size_t(s.report.rounds % 2);
    // The first samples of an image follow no learned rule.
    const int64_t sample = s.rule.settings.roulette.learns() ? AdjointChoice::first_sample : 0;
    for (const size_t turn : {first, 1 - first})
        if (!turns[turn]->render(s.scene, s.report.rounds, sample, s.report.spp, wanted)) return false;
    ++s.report.rounds;
    s.report.rule = s.rule.figures(s.report.spp);
    s.report.none = s.none.figures(s.report.spp);
    s.compare_means();
    s.measure_gain();
    return true;
}

const RouletteReport& RouletteComparison::report() const { return state_->report; }

} // namespace blush
