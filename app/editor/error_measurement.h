// Measures errors that an image cannot estimate itself, in the background: raw and denoised images against a reference;
// without one, denoised images against later raw images. Limited to a fraction of the render time, plus once at the end.
#pragma once

#include "core/time_budget.h"
#include "measure/convergence/convergence_runs.h"
#include "measure/convergence/reference.h"
#include "measure/metrics/image_error.h"
#include "render/session/published_frames.h"
#include "ui/jobs/background_job.h"

#include <functional>
#include <memory>
#include <vector>

namespace blush {

class ErrorMeasurement {
public:
    // `wake` is called on another thread when a result is available.
    explicit ErrorMeasurement(std::function<void()> wake) : wake_(std::move(wake)) {}

    // A new run begins: drops pending images of the last one.
    void begin(int run);
    // The same run shows another image: drops pending images.
    void forget_images();
    // Queues the images of a due point of the run; they are kept until measured. Only in full resolution.
    void add_raw(const FramePtr& frame);
    void add_denoised(const DenoisedPtr& image);
    // Number of denoised images whose error is not in the run's record yet.
    size_t waiting(const ConvergenceRecord& record) const;

    // Call once per UI frame: adds results to the runs, and starts the next measurement against the run's `reference` or, without
    // one, against `raw`, the newest frame. Either may be null.
    void poll(ConvergenceRuns& runs, const std::shared_ptr<const Reference>& reference, const FramePtr& raw);
    // Total time of all measurements of this run.
    double seconds() const { return budget_.spent(); }

private:
    // A denoised image; oldest first.
    struct Waiting {
        DenoisedPtr image;
        int64_t measured_at = 0; // samples of the raw image in its last measurement
    };
    struct Measured {
        ConvergencePoint point;
        DenoisedPtr settled; // its error estimate is final
        double pixels = 0, seconds = 0;
    };
    using Work = std::function<Measured(JobProgress&)>;

    void take(ConvergenceRuns& runs);
    Work against_reference(const std::shared_ptr<const Reference>& reference);
    Work against_raw(const FramePtr& raw);

    std::function<void()> wake_;
    int run_ = 0, measured_run_ = 0;
    TimeBudget budget_{max_measuring_share};
    FramePtr raw_; // the newest pending one
    std::vector<Waiting> denoised_;
    std::unique_ptr<BackgroundJob<Measured>> job_;
};

} // namespace blush
