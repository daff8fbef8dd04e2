#include "measure/lab/strategy_comparison.h"

#include "core/math.h"
#include "measure/convergence/reference.h"
#include "measure/lab/lab_settings.h"
#include "measure/metrics/image_error.h"
#include "render/compile/expanded_lights.h"
#include "render/film/found_by.h"
#include "render/lights/missing_light.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

namespace blush {
namespace {

using Wanted = std::function<bool()>;
using Kind = ConvergencePoint::Kind;

constexpr int64_t least_samples = 2;  // both half buffers need one for an error
constexpr int64_t most_at_once = 256; // samples between two looks at the clock

double luminance_of(const Vec3& v) { return luminance(Vec3d{double(v.x), double(v.y), double(v.z)}); }

// Processor time of this thread leaves out what other threads of a busy machine take from it.
double seconds_now(bool single_thread) {
    timespec t{};
    if (single_thread && clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t) == 0) return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Variance of one sample of each pixel, from the scatter of the means of rounds: for rounds of n_r samples with means x_r, the sum of
// n_r (x_r - mean)^2 / (rounds - 1) has the variance of one sample as its mean, if samples are independent.
class RoundVariance {
public:
    // `means`: of all samples so far.
    void add(const std::vector<double>& means, int64_t samples) {
        squares_.resize(means.size());
        const double before = double(samples_), all = double(samples), own = all - before;
        for (size_t i = 0; rounds_ > 0 && i < means.size(); ++i) {
            const double x = (means[i] * all - means_[i] * before) / own;
            squares_[i] += own * (x - means_[i]) * (x - means[i]);
        }
        means_ = means;
        samples_ = samples;
        ++rounds_;
    }
    // Empty before two rounds.
    std::vector<float> variance() const {
        std::vector<float> v;
        if (rounds_ < 2) return v;
        v.reserve(squares_.size());
        for (const double s : squares_) v.push_back(float(std::max(0.0, s) / double(rounds_ - 1)));
        return v;
    }

private:
    std::vector<double> means_, squares_;
    int64_t samples_ = 0, rounds_ = 0;
};

std::vector<double> luminances(const std::vector<Vec3>& plane) {
    std::vector<double> v;
    v.reserve(plane.size());
    for (const Vec3& p : plane) v.push_back(luminance_of(p));
    return v;
}

struct SideRender {
    std::unique_ptr<Renderer> renderer;
    Frame frame; // after the last round
    int64_t samples = 0;
    double seconds = 0;
    RoundVariance variance;

    void begin(const RendererOptions& options, const Scene& scene, RenderSettings settings, Strategy strategy) {
        if (!renderer) {
            RendererOptions own = options;
            own.planes = {.strategies = strategy == Strategy::mis};
            renderer = std::make_unique<Renderer>(own);
        }
        settings.strategy = strategy;
        settings.seed += uint32_t(strategy); // independent samples: see StrategySide::record
        renderer->update(scene, settings);
        renderer->clear();
        samples = 0;
        seconds = 0;
        variance = {};
    }
    bool render(int64_t count, bool single_thread, const Wanted& wanted) {
        const double begin = seconds_now(single_thread);
        if (!renderer->render(samples, count, wanted)) return false;
        seconds += seconds_now(single_thread) - begin;
        samples += count;
        return true;
    }
    bool render_until(double goal, bool single_thread, const Wanted& wanted) {
        while (samples < least_samples || seconds < goal) {
            // Half of what fits, and one sample at last: the time exceeds the goal by less than that of one, even if the next samples are
            // slower than those before.
            const double left = samples > 0 && seconds > 0 ? (goal - seconds) / seconds * double(samples) / 2 : 0;
            const int64_t least = samples < least_samples ? least_samples - samples : 1;
            if (!render(std::clamp(int64_t(left), least, most_at_once), single_thread, wanted)) return false;
        }
        return true;
    }
    std::vector<Vec3> image() const {
        std::vector<Vec3> rgb;
        rgb.reserve(frame.rgba.size() / 4);
        for (size_t i = 0; i + 3 < frame.rgba.size(); i += 4) rgb.push_back({frame.rgba[i], frame.rgba[i + 1], frame.rgba[i + 2]});
        return rgb;
    }
};

// By which part of MIS a strategy of the film has found light: BSDF sampling or light sampling.
size_t part_of(FoundBy by) { return by == FoundBy::nee ? 1 : 0; }

} // namespace

struct StrategyComparison::State {
    RendererOptions options;
    bool single_thread = false;
    StrategyBudget budget = StrategyBudget::time;
    std::array<SideRender, 3> sides;
    std::array<RoundVariance, 2> part_variance;
    StrategyReport report;

    // No side may be behind one that has had a slow sample.
    double goal() const {
        double most = double(report.rounds + 1) * strategy_round_seconds;
        for (const SideRender& side : sides) most = std::max(most, side.seconds);
        return most;
    }
    bool render(const Wanted& wanted) {
        const double until = goal();
        for (size_t turn = 0; turn < sides.size(); ++turn) {
            SideRender& side = sides[(turn + size_t(report.rounds)) % sides.size()];
            const bool done = budget == StrategyBudget::time ? side.render_until(until, single_thread, wanted)
                                                             : side.render(strategy_round_samples, single_thread, wanted);
            if (!done) return false;
        }
        return true;
    }

    void report_side(size_t k) {
        SideRender& side = sides[k];
        StrategySide& shown = report.sides[k];
        if (side.samples == shown.samples) return;
        side.renderer->resolve(side.frame);
        shown.samples = side.samples;
        shown.seconds = side.seconds;
        shown.dropped = side.frame.health.dropped();
        shown.image = side.image();
        side.variance.add(luminances(shown.image), side.samples);
        shown.variance = side.variance.variance();
    }

    void report_parts() {
        const Frame& frame = sides[2].frame;
        std::array<std::vector<double>, 2> light;
        for (auto& plane : light) plane.assign(frame.rgba.size() / 4, 0);
        for (size_t by = 0; by < frame.strategies.size(); ++by) {
            std::vector<double>& plane = light[part_of(FoundBy(by))];
            for (size_t i = 0; i < plane.size(); ++i) plane[i] += luminance_of(frame.strategies[by][i]);
        }
        double whole = 0, own[2] = {};
        for (auto& part : report.parts) part.weight.assign(light[0].size(), 0);
        for (size_t i = 0; i < light[0].size(); ++i) {
            const double sum = light[0][i] + light[1][i];
            whole += sum;
            for (size_t k = 0; k < 2; ++k) {
                own[k] += light[k][i];
                if (sum > 0) report.parts[k].weight[i] = float(light[k][i] / sum);
            }
        }
        for (size_t k = 0; k < 2; ++k) {
            report.parts[k].share = whole > 0 ? own[k] / whole : 0;
            part_variance[k].add(light[k], sides[2].samples);
            report.parts[k].variance = part_variance[k].variance();
        }
    }

    void report_errors() {
        const auto due = [&](size_t k) {
            return report.sides[k].record.is_due(k == 2 ? Kind::estimated : Kind::measured, sides[k].samples);
        };
        if (!due(0) && !due(1) && !due(2)) return;
        if (due(2)) {
            ConvergencePoint p = estimated_point(sides[2].renderer->resolve());
            p.seconds = sides[2].seconds;
            p.spp = sides[2].samples;
            // Without noise nothing says whether light is missing: a black image is the usual case.
            p.rmse.known = p.rmse.known && p.rmse.value > 0;
            p.relmse.known = p.relmse.known && p.relmse.value > 0;
            report.sides[2].record.add(p);
        }
        const MeasuredImage reference = measured_image(*sides[2].renderer);
        if (reference.error.empty()) return;
        for (size_t k = 0; k < 2; ++k) {
            if (!due(k)) continue;
            const ImageError e = error_against({sides[k].frame.rgba, 4}, reference);
            report.sides[k].record.add({Kind::measured, sides[k].seconds, sides[k].samples, e.rmse, e.relmse});
        }
    }
};

Interval StrategySide::error(ErrorMetric metric) const {
    return record.points().empty() ? Interval{} : record.points().back().error(metric);
}

StrategyComparison::StrategyComparison(const RendererOptions& options) : state_(std::make_unique<State>()) {
    state_->options = options;
    state_->single_thread = options.threads == 1;
}
StrategyComparison::~StrategyComparison() = default;

void StrategyComparison::begin(const Scene& scene, const RenderSettings& settings, StrategyBudget budget, int longest) {
    State& s = *state_;
    const RenderSettings small = plain_lab_settings(settings, longest);
    for (size_t k = 0; k < s.sides.size(); ++k) s.sides[k].begin(s.options, scene, small, compared_strategies[k]);
    s.budget = budget;
    s.part_variance = {};
    s.report = {};
    s.report.width = small.width;
    s.report.height = small.height;
    s.report.zero_size_lights = count_zero_size_lights(scene, nodes_with_lights(scene));
}

bool StrategyComparison::round(const Wanted& wanted) {
    State& s = *state_;
    if (!s.render(wanted)) return false;
    const int64_t mis_before = s.report.mis().samples;
    for (size_t k = 0; k < s.sides.size(); ++k) s.report_side(k);
    if (s.report.mis().samples != mis_before) s.report_parts();
    s.report_errors();
    ++s.report.rounds;
    return true;
}

const StrategyReport& StrategyComparison::report() const { return state_->report; }

} // namespace blush
