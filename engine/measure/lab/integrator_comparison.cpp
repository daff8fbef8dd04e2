#include "measure/lab/integrator_comparison.h"

#include "measure/convergence/reference.h"
#include "measure/lab/lab_settings.h"
#include "measure/metrics/image_error.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

using Kind = ConvergencePoint::Kind;

Interval latest(const ConvergenceRecord& record, ErrorMetric metric) {
    return record.points().empty() ? Interval{} : record.points().back().error(metric);
}

// The reference with the noise of both images, so that error_against() gives the bias alone.
MeasuredImage with_noise_of(MeasuredImage reference, const MeasuredImage& image) {
    for (size_t i = 0; i < reference.error.size(); ++i) {
        Vec3& e = reference.error[i];
        const Vec3& f = image.error[i];
        e = {std::hypot(e.x, f.x), std::hypot(e.y, f.y), std::hypot(e.z, f.z)};
    }
    return reference;
}

struct IntegratorRender {
    TimedRender timed;
    Frame frame; // after the last round

    void report(IntegratorSide& shown) {
        timed.renderer().resolve(frame);
        shown.samples = timed.samples();
        shown.seconds = timed.seconds();
        shown.dropped = frame.health.dropped();
        shown.image = rgb_of(frame);
        if (!shown.noise.is_due(Kind::estimated, shown.samples)) return;
        ConvergencePoint p = estimated_point(timed.renderer().resolve());
        p.seconds = shown.seconds;
        p.spp = shown.samples;
        // Without noise nothing says whether light is missing: a black image is the usual case.
        p.rmse.known = p.rmse.known && p.rmse.value > 0;
        p.relmse.known = p.relmse.known && p.relmse.value > 0;
        shown.noise.add(p);
    }
};

} // namespace

struct IntegratorComparison::State {
    RendererOptions options;
    ComparisonIntegrator integrator; // of `biased`
    IntegratorRender path, biased;
    IntegratorReport report;

    // Neither side may be behind the other after a long preparation or a slow sample.
    double goal() const {
        return std::max({double(report.rounds + 1) * integrator_round_seconds, path.timed.seconds(), biased.timed.seconds()});
    }
    bool render(const TimedRender::Wanted& wanted) {
        // The first round prepares: what that takes is known before the path tracer renders as long.
        const bool biased_first = report.rounds % 2 == 0;
        IntegratorRender &first = biased_first ? biased : path, &second = biased_first ? path : biased;
        return first.timed.render_until(goal(), wanted) && second.timed.render_until(goal(), wanted);
    }
    void compare() {
        IntegratorReport& r = report;
        if (!r.error.is_due(Kind::measured, r.biased.samples)) return;
        const MeasuredImage reference = measured_image(path.timed.renderer()), image = measured_image(biased.timed.renderer());
        if (reference.error.empty() || image.error.empty()) return;
        const ImageError whole = error_against({biased.frame.rgba, 4}, reference),
                         bias = error_against({biased.frame.rgba, 4}, with_noise_of(reference, image));
        r.error.add({Kind::measured, r.biased.seconds, r.biased.samples, whole.rmse, whole.relmse});
        r.bias_rmse = bias.rmse;
        r.bias_relmse = bias.relmse;
        r.verdict = test_bias(image, reference);
    }
};

Interval IntegratorSide::noise_error(ErrorMetric metric) const { return latest(noise, metric); }
Interval IntegratorReport::latest_error(ErrorMetric metric) const { return latest(error, metric); }

IntegratorComparison::IntegratorComparison(const RendererOptions& options) : state_(std::make_unique<State>()) {
    state_->options = options;
}
IntegratorComparison::~IntegratorComparison() = default;

void IntegratorComparison::begin(const Scene& scene, const RenderSettings& settings, const ComparisonIntegrator& integrator, int longest) {
    State& s = *state_;
    RenderSettings small = plain_lab_settings(settings, longest);
    s.path.timed.begin(s.options, scene, small);
    // The integrator of a renderer cannot change. One that is baked keeps what it has prepared.
    if (!integrator.baked || integrator != s.integrator) s.biased = {};
    s.integrator = integrator;
    RendererOptions own = s.options;
    own.integrator = integrator;
    ++small.seed;
    s.biased.timed.begin(own, scene, small);
    s.report = {};
    s.report.width = small.width;
    s.report.height = small.height;
}

bool IntegratorComparison::round(const std::function<bool()>& wanted) {
    State& s = *state_;
    if (!s.render(wanted)) return false;
    s.path.report(s.report.path);
    s.biased.report(s.report.biased);
    s.compare();
    ++s.report.rounds;
    return true;
}

const IntegratorReport& IntegratorComparison::report() const { return state_->report; }

} // namespace blush
