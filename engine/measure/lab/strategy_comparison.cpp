#include "measure/lab/strategy_comparison.h"

#include "core/math.h"
#include "measure/convergence/reference.h"
#include "measure/lab/lab_settings.h"
#include "measure/lab/timed_render.h"
#include "measure/metrics/image_error.h"
#include "render/compile/expanded_lights.h"
#include "render/film/found_by.h"
#include "render/lights/missing_light.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

using Wanted = TimedRender::Wanted;
using Kind = ConvergencePoint::Kind;

double luminance_of(const Vec3& v) { return luminance(Vec3d{double(v.x), double(v.y), double(v.z)}); }

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
    TimedRender timed;
    Frame frame; // after the last round
    RoundVariance variance;

    void begin(const RendererOptions& options, const Scene& scene, RenderSettings settings, Strategy strategy) {
        RendererOptions own = options;
        own.planes = {.strategies = strategy == Strategy::mis};
        settings.strategy = strategy;
        settings.seed += uint32_t(strategy); // independent samples: see StrategySide::record
        timed.begin(own, scene, settings);
        variance = {};
    }
};

// By which part of MIS a strategy of the film has found light: BSDF sampling or light sampling.
size_t part_of(FoundBy by) { return by == FoundBy::nee ? 1 : 0; }

} // namespace

struct StrategyComparison::State {
    RendererOptions options;
    StrategyBudget budget = StrategyBudget::time;
    std::array<SideRender, 3> sides;
    std::array<RoundVariance, 2> part_variance;
    StrategyReport report;

    // No side may be behind one that has had a slow sample.
    double goal() const {
        double most = double(report.rounds + 1) * strategy_round_seconds;
        for (const SideRender& side : sides) most = std::max(most, side.timed.seconds());
        return most;
    }
    bool render(const Wanted& wanted) {
        const double until = goal();
        for (size_t turn = 0; turn < sides.size(); ++turn) {
            SideRender& side = sides[(turn + size_t(report.rounds)) % sides.size()];
            const bool done =
                budget == StrategyBudget::time ? side.timed.render_until(until, wanted) : side.timed.render(strategy_round_samples, wanted);
            if (!done) return false;
        }
        return true;
    }

    void report_side(size_t k) {
        SideRender& side = sides[k];
        StrategySide& shown = report.sides[k];
        if (side.timed.samples() == shown.samples) return;
        side.timed.renderer().resolve(side.frame);
        shown.samples = side.timed.samples();
        shown.seconds = side.timed.seconds();
        shown.dropped = side.frame.health.dropped();
        shown.image = rgb_of(side.frame);
        side.variance.add(luminances(shown.image), shown.samples);
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
            part_variance[k].add(light[k], sides[2].timed.samples());
            report.parts[k].variance = part_variance[k].variance();
        }
    }

    void report_errors() {
        const auto due = [&](size_t k) {
            return report.sides[k].record.is_due(k == 2 ? Kind::estimated : Kind::measured, sides[k].timed.samples());
        };
        if (!due(0) && !due(1) && !due(2)) return;
        if (due(2)) {
            ConvergencePoint p = estimated_point(sides[2].timed.renderer().resolve());
            p.seconds = sides[2].timed.seconds();
            p.spp = sides[2].timed.samples();
            // Without noise nothing says whether light is missing: a black image is the usual case.
            p.rmse.known = p.rmse.known && p.rmse.value > 0;
            p.relmse.known = p.relmse.known && p.relmse.value > 0;
            report.sides[2].record.add(p);
        }
        const MeasuredImage reference = measured_image(sides[2].timed.renderer());
        if (reference.error.empty()) return;
        for (size_t k = 0; k < 2; ++k) {
            if (!due(k)) continue;
            const ImageError e = error_against({sides[k].frame.rgba, 4}, reference);
            report.sides[k].record.add({Kind::measured, sides[k].timed.seconds(), sides[k].timed.samples(), e.rmse, e.relmse});
        }
    }
};

Interval StrategySide::error(ErrorMetric metric) const {
    return record.points().empty() ? Interval{} : record.points().back().error(metric);
}

StrategyComparison::StrategyComparison(const RendererOptions& options) : state_(std::make_unique<State>()) { state_->options = options; }
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
