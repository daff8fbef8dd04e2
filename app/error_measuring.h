// Measures the error of pictures that cannot tell it themselves, in the background: raw and denoised ones against a reference, denoised
// ones without one against the raw picture as it gets better.
#pragma once

#include "measure/convergence_runs.h"
#include "measure/picture_error.h"
#include "measure/reference.h"
#include "render/showcase.h"
#include "ui/background_job.h"

#include <functional>
#include <memory>
#include <vector>

namespace blush {

class ErrorMeasuring {
public:
    // `wake` is called on another thread when something was measured.
    explicit ErrorMeasuring(std::function<void()> wake) : wake_(std::move(wake)) {}

    // Another run begins: pictures of the last one are measured no further.
    void begin(int run);
    // Pictures of the run whose points are due: held until they are measured. Those in full resolution only.
    void add_raw(const FramePtr& frame);
    void add_denoised(const DenoisedPtr& picture);
    // Denoised ones that have no point in their run's record yet.
    size_t waiting(const ConvergenceRecord& record) const;

    // Once per frame of the window: puts what was measured into the runs, and measures on if there is something to measure against:
    // `reference` of the run's picture, or else `raw`, the newest frame. Either may be null.
    void poll(ConvergenceRuns& runs, const std::shared_ptr<const Reference>& reference, const FramePtr& raw);
    // Of all measuring for this run so far.
    double seconds() const { return seconds_; }

private:
    struct Measured {
        std::vector<ConvergencePoint> points;
        std::vector<DenoisedPtr> settled; // whose error is known as well as it can be
        double seconds = 0;
    };
    using Work = std::function<Measured(JobProgress&)>;

    void take(ConvergenceRuns& runs);
    bool judges_better(const Frame& raw) const; // than the one before
    Work against_reference(const std::shared_ptr<const Reference>& reference);
    Work against_raw(const FramePtr& raw) const;

    std::function<void()> wake_;
    int run_ = 0, measured_run_ = 0;
    double seconds_ = 0;
    std::vector<FramePtr> raw_;
    std::vector<DenoisedPtr> denoised_; // oldest first
    int64_t judged_at_ = 0;             // samples of the raw picture that denoised ones were last held against
    std::unique_ptr<BackgroundJob<Measured>> job_;
};

} // namespace blush
