#include "app/editor/error_measurement.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace blush {
namespace {

using Clock = std::chrono::steady_clock;
using Kind = ConvergencePoint::Kind;

constexpr size_t max_denoised_bytes = size_t(256) << 20; // of denoised images that wait for a better raw image
constexpr double remeasure_growth = 1.4;                 // factor of the raw image's samples between two measurements

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

ConvergencePoint point_of(const DenoisedImage& image, const ImageError& error) {
    return {Kind::denoised, image.rendered_seconds, image.samples, error.rmse, error.relmse};
}

bool known(const ConvergencePoint& p) { return p.rmse.known || p.relmse.known; }

// Points without a usable interval get no value either.
ConvergencePoint only_known(ConvergencePoint p) {
    if (!p.rmse.known) p.rmse = {};
    if (!p.relmse.known) p.relmse = {};
    return p;
}

} // namespace

void ErrorMeasurement::begin(int run) {
    run_ = run;
    budget_.restart();
    forget_images();
}

void ErrorMeasurement::forget_images() {
    raw_.reset();
    denoised_.clear();
}

void ErrorMeasurement::add_raw(const FramePtr& frame) { raw_ = frame; }

void ErrorMeasurement::add_denoised(const DenoisedPtr& image) {
    const size_t bytes = std::max<size_t>(1, image->denoised.rgb.size() * sizeof(float));
    while (!denoised_.empty() && (denoised_.size() + 1) * bytes > max_denoised_bytes) denoised_.erase(denoised_.begin());
    denoised_.push_back({image});
}

size_t ErrorMeasurement::waiting(const ConvergenceRecord& record) const {
    const std::vector<ConvergencePoint> points = record.points(Kind::denoised);
    return size_t(std::ranges::count_if(
        denoised_, [&](const Waiting& w) { return std::ranges::find(points, w.image->samples, &ConvergencePoint::spp) == points.end(); }));
}

void ErrorMeasurement::take(ConvergenceRuns& runs) {
    auto measured = job_->take();
    if (!measured) return;
    job_.reset();
    if (measured_run_ == run_) {
        budget_.record(measured->pixels, measured->seconds);
        std::erase_if(denoised_, [&](const Waiting& w) { return w.image == measured->settled; });
    }
    if (ConvergenceRun* run = runs.find(measured_run_); run && known(measured->point)) run->record.set(only_known(measured->point));
}

void ErrorMeasurement::poll(ConvergenceRuns& runs, const std::shared_ptr<const Reference>& reference, const FramePtr& raw) {
    if (job_) take(runs);
    if (job_ || !raw) return;
    if (!raw->complete && !budget_.allows(double(raw->width) * double(raw->height), raw->seconds)) return;
    Work work = reference ? against_reference(reference) : against_raw(raw);
    if (!work) return;
    measured_run_ = run_;
    job_ = std::make_unique<BackgroundJob<Measured>>("Measuring errors", std::move(work), wake_);
}

// Each image once: the reference does not improve by itself. Empty if nothing is pending.
ErrorMeasurement::Work ErrorMeasurement::against_reference(const std::shared_ptr<const Reference>& reference) {
    if (const FramePtr frame = std::exchange(raw_, nullptr))
        return [=](JobProgress&) {
            const auto begin = Clock::now();
            const ImageError e = error_against({frame->rgba, 4}, reference->measured);
            const ConvergencePoint point{Kind::measured, frame->seconds, frame->samples, e.rmse, e.relmse};
            return Measured{point, nullptr, double(frame->rgba.size() / 4), seconds_since(begin)};
        };
    if (denoised_.empty()) return {};
    return [reference, image = denoised_.front().image](JobProgress&) {
        const auto begin = Clock::now();
        const ConvergencePoint point = point_of(*image, error_against({image->denoised.rgb, 3}, reference->measured));
        return Measured{point, image, double(image->denoised.rgb.size() / 3), seconds_since(begin)};
    };
}

// The image whose last measurement used the fewest raw samples; it stays in the queue for better raw images. Empty if the
// current raw image would not improve any.
ErrorMeasurement::Work ErrorMeasurement::against_raw(const FramePtr& raw) {
    const auto w = std::ranges::min_element(denoised_, {}, &Waiting::measured_at);
    if (w == denoised_.end() || w->image->samples >= raw->samples) return {};
    const double growth = double(raw->samples) / std::max(1.0, double(w->measured_at));
    if (raw->complete ? growth <= 1 : growth < remeasure_growth) return {};
    w->measured_at = raw->samples;
    return [raw, image = w->image](JobProgress&) {
        const auto begin = Clock::now();
        const ConvergencePoint point = point_of(*image, error_against({image->denoised.rgb, 3}, {raw->rgba, 4}, raw->error));
        return Measured{point, nullptr, double(image->denoised.rgb.size() / 3), seconds_since(begin)};
    };
}

} // namespace blush
