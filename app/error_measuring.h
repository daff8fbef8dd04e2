// Measures the error of pictures that cannot tell it themselves, in the background: raw and denoised ones against a reference, denoised
// ones without one against the raw picture as it gets better. As often as fits into a share of the rendering time, and once more at the end.
#pragma once

#include "core/time_budget.h"
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
    // The same run shows another picture: the ones that wait are measured no further.
    void forget_pictures();
    // Pictures of the run whose points are due: held until they are measured. Those in full resolution only.
    void add_raw(const FramePtr& frame);
    void add_denoised(const DenoisedPtr& picture);
    // Denoised ones that have no point in their run's record yet.
    size_t waiting(const ConvergenceRecord& record) const;

    // Once per frame of the window: puts what was measured into the runs, and measures on if there is something to measure against:
    // `reference` of the run's picture, or else `raw`, the newest frame. Either may be null.
    void poll(ConvergenceRuns& runs, const std::shared_ptr<const Reference>& reference, const FramePtr& raw);
    // Of all measuring for this run so far.
    double seconds() const { return budget_.spent(); }

private:
    // A denoised picture; oldest first.
    struct Waiting {
        DenoisedPtr picture;
        int64_t judged_at = 0; // samples of the raw picture that it was last held against
    };
    struct Measured {
        ConvergencePoint point;
        DenoisedPtr settled; // its error is known as well as it can be
        double pixels = 0, seconds = 0;
    };
    using Work = std::function<Measured(JobProgress&)>;

    void take(ConvergenceRuns& runs);
    Work against_reference(const std::shared_ptr<const Reference>& reference);
    Work against_raw(const FramePtr& raw);

    std::function<void()> wake_;
    int run_ = 0, measured_run_ = 0;
    TimeBudget budget_{measuring_share};
    FramePtr raw_; // the newest that waits
    std::vector<Waiting> denoised_;
    std::unique_ptr<BackgroundJob<Measured>> job_;
};

} // namespace blush
