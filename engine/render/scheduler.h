// What to render next: a pure object, told how long things took, that says what is due. Tested without rendering.
#pragma once

#include "scene/render_settings.h"

#include <cstdint>

namespace blush {

// One piece of work for the render thread.
struct Work {
    int divider = 1;           // full resolution / film resolution
    int64_t first_sample = 0;
    int64_t count = 0;         // samples per pixel
    bool clear = false;        // the film holds something else: another divider, or nothing worth keeping
    bool always_finish = false; // the first picture of a revision is never cancelled, so that a drag always shows something
    bool publish = false;      // resolve and hand out a frame afterwards
};

// Cadence follows Cycles' in spirit: a first picture within a display frame, then full resolution, then batches whose display
// interval grows, because resolving costs and eyes get patient.
class Scheduler {
public:
    struct Timings {
        // Seconds to trace one sample of every pixel at full resolution; 0: not known yet.
        double sample_seconds = 0;
    };

    static constexpr double first_image_seconds = 1.0 / 60; // to trace the coarse picture: stopping, resolving and drawing take their share
    static constexpr int coarsest_divider = 16;
    static constexpr int smallest_long_side = 96; // pixels of the coarse picture, unless the full one is smaller

    // Timings survive a restart: the next revision is probably as heavy as this one.
    void restart(const RenderSettings& settings, bool interactive);
    // After a restart: goes on from so many samples per pixel, rendered in `seconds`.
    void resume(int64_t samples, double seconds);
    // The stop rules changed, the image did not.
    void change_stop_rules(const RenderSettings& settings) { settings_ = settings; }
    // `work` was rendered in `seconds`.
    void record_render(const Work& work, double seconds);
    // Its frame was published.
    void record_publish() { last_publish_ = seconds_; }
    // The relMSE of the picture as it is now, in full resolution, was estimated; negative if not known.
    void record_error(double error);
    // May the stop rule by error be met by now, as the last estimate goes on? Then it is worth another.
    bool error_may_be_reached() const { return error_may_be_reached(samples()); }

    bool finished() const;
    // Towards the nearest stop rule, [0, 1]; 1 only when finished.
    double progress() const;
    // Only if not finished.
    Work next() const;

    int64_t samples() const { return next_sample_ - settings_.first_sample; }
    double seconds() const { return seconds_; }
    const Timings& timings() const { return timings_; }

private:
    int first_divider() const;
    double publish_interval() const;
    bool error_may_be_reached(int64_t samples) const;

    RenderSettings settings_;
    Timings timings_;
    int film_divider_ = 0; // 0: nothing rendered yet
    int64_t next_sample_ = 0;
    bool interactive_ = true;
    double seconds_ = 0;         // rendered at this revision
    double last_publish_ = 0;    // seconds_ when last published
    double error_ = -1;          // last estimated, with
    int64_t error_samples_ = 0;
};

} // namespace blush
