#include "app/error_measuring.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace blush {
namespace {

using Clock = std::chrono::steady_clock;
using Kind = ConvergencePoint::Kind;

constexpr size_t most_raw = 2;                            // that wait for the one being measured
constexpr size_t most_denoised_bytes = size_t(256) << 20; // that wait for the raw picture to get better
constexpr double judging_growth = 1.4;                    // of the raw picture's samples

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

ConvergencePoint point_of(const DenoisedPicture& picture, const PictureError& error) {
    return {Kind::denoised, picture.rendered_seconds, picture.samples, error.rmse, error.relmse};
}

bool known(const ConvergencePoint& p) { return p.rmse.known || p.relmse.known; }

// Intervals that say nothing are left out of a point, values that stand for nothing with them.
ConvergencePoint only_known(ConvergencePoint p) {
    if (!p.rmse.known) p.rmse = {};
    if (!p.relmse.known) p.relmse = {};
    return p;
}

} // namespace

void ErrorMeasuring::begin(int run) {
    run_ = run;
    seconds_ = 0;
    judged_at_ = 0;
    raw_.clear();
    denoised_.clear();
}

void ErrorMeasuring::add_raw(const FramePtr& frame) {
    if (raw_.size() < most_raw) raw_.push_back(frame);
}

void ErrorMeasuring::add_denoised(const DenoisedPtr& picture) {
    const size_t bytes = std::max<size_t>(1, picture->denoised.rgb.size() * sizeof(float));
    while (!denoised_.empty() && (denoised_.size() + 1) * bytes > most_denoised_bytes) denoised_.erase(denoised_.begin());
    denoised_.push_back(picture);
}

size_t ErrorMeasuring::waiting(const ConvergenceRecord& record) const {
    const std::vector<ConvergencePoint> points = record.points(Kind::denoised);
    return size_t(std::ranges::count_if(
        denoised_, [&](const DenoisedPtr& d) { return std::ranges::find(points, d->samples, &ConvergencePoint::spp) == points.end(); }));
}

void ErrorMeasuring::take(ConvergenceRuns& runs) {
    auto measured = job_->take();
    if (!measured) return;
    job_.reset();
    if (measured_run_ == run_) {
        seconds_ += measured->seconds;
        std::erase_if(denoised_, [&](const DenoisedPtr& p) { return std::ranges::find(measured->settled, p) != measured->settled.end(); });
    }
    if (ConvergenceRun* run = runs.find(measured_run_))
        for (const ConvergencePoint& p : measured->points) run->record.set(p);
}

bool ErrorMeasuring::judges_better(const Frame& raw) const {
    const double growth = double(raw.samples) / std::max(1.0, double(judged_at_));
    return raw.complete ? growth > 1 : growth >= judging_growth;
}

void ErrorMeasuring::poll(ConvergenceRuns& runs, const std::shared_ptr<const Reference>& reference, const FramePtr& raw) {
    if (job_) take(runs);
    if (job_) return;
    Work work;
    if (reference && (!raw_.empty() || !denoised_.empty()))
        work = against_reference(reference);
    else if (!reference && raw && !denoised_.empty() && judges_better(*raw)) {
        judged_at_ = raw->samples;
        work = against_raw(raw);
    }
    if (!work) return;
    measured_run_ = run_;
    job_ = std::make_unique<BackgroundJob<Measured>>("Measuring errors", std::move(work), wake_);
}

// All there are, once: the reference does not get better by itself.
ErrorMeasuring::Work ErrorMeasuring::against_reference(const std::shared_ptr<const Reference>& reference) {
    return [reference, raw = std::exchange(raw_, {}), denoised = denoised_](JobProgress& progress) {
        const auto begin = Clock::now();
        Measured m;
        const auto add = [&](ConvergencePoint point) {
            if (known(point)) m.points.push_back(only_known(point));
        };
        for (const FramePtr& frame : raw) {
            if (progress.cancel) break;
            const PictureError e = error_against({frame->rgba, 4}, reference->measured);
            add({Kind::measured, frame->seconds, frame->samples, e.rmse, e.relmse});
        }
        for (const DenoisedPtr& picture : denoised) {
            if (progress.cancel) break;
            add(point_of(*picture, error_against({picture->denoised.rgb, 3}, reference->measured)));
            m.settled.push_back(picture);
        }
        m.seconds = seconds_since(begin);
        return m;
    };
}

// Those of fewer samples; they stay, as a later picture judges them better.
ErrorMeasuring::Work ErrorMeasuring::against_raw(const FramePtr& raw) const {
    return [raw, denoised = denoised_](JobProgress& progress) {
        const auto begin = Clock::now();
        Measured m;
        for (const DenoisedPtr& picture : denoised) {
            if (progress.cancel) break;
            if (picture->samples >= raw->samples) continue;
            const ConvergencePoint point = point_of(*picture, error_against({picture->denoised.rgb, 3}, {raw->rgba, 4}, raw->error));
            if (known(point)) m.points.push_back(only_known(point));
        }
        m.seconds = seconds_since(begin);
        return m;
    };
}

} // namespace blush
