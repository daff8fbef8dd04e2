// Decides what to render next from measured times; pure computation, testable without rendering.
#pragma once

#include "scene/render_settings.h"

#include <cstdint>

namespace blush {

// A work item of the render thread.
struct Work {
    int divider = 1; // full resolution / film resolution
    int64_t first_sample = 0;
    int64_t count = 0;          // samples per pixel
    bool clear = false;         // clears the film: another divider, or outdated contents
    bool always_finish = false; // the first frame of a revision is never cancelled, so that a drag always shows something
    bool publish = false;       // resolve and publish a frame afterwards
    bool decides = false;       // the pilots that these samples need run before them
    bool completes = false;     // no sample: more light paths of the first one
};

// Similar to Cycles: a first image within a display frame, more samples of it, or with denoising a finer one, while a first sample at
// full resolution would take much longer, then full resolution, then batches with growing display intervals,
// because resolving costs time and later updates are less urgent.
class Scheduler {
public:
    struct Timings {
        // Seconds per sample of every pixel at full resolution, as of the last ones; 0: unknown.
        double sample_seconds = 0;
        // The same of first samples and coarse images, which pilots have no part in; 0: unknown.
        double first_sample_seconds = 0;
        // The same where these begin with kept seeds of manifold sampling, whose walks take time.
        double seeded_first_sample_seconds = 0;
    };

    // Tracing time of the coarse image: half a frame of 60 Hz. Cancelling, resolving and drawing take the rest.
    static constexpr double first_image_seconds = 1.0 / 120;
    // The same with denoising, if each first image is denoised before it is shown and may be half as fine for it.
    static constexpr double first_denoised_seconds = 1.0 / 40;
    // Ratio of measured times that counts as noise: within it, the first image keeps the resolution of the last one.
    static constexpr double timing_tolerance = 1.1;
    // Coarse images get samples until they took this share of a sample at full resolution: until that is shown, more samples in fewer
    // pixels have the lower error.
    static constexpr double coarse_share = 0.25;
    // With denoising, a second coarse image of this many samples, after as many of the first, takes at most this share of the time of a
    // denoised sample at full resolution: the network removes noise, but adds no pixels.
    static constexpr int64_t refined_samples = 4;
    static constexpr double refined_share = 0.12;
    static constexpr double least_refinement = 1.6; // of the sides, over the first
    static constexpr int coarsest_divider = 16;
    static constexpr int min_long_side = 96; // pixels of the coarse image, unless the full one is smaller

    // Timings survive a restart: the next revision probably costs about the same.
    void restart(const RenderSettings& settings, bool interactive);
    struct DenoisingTimes {
        double coarse = 0;    // seconds per film pixel of a first, coarse image; 0: first images are shown as they are
        double whole = 0;     // the same of a whole image; 0: unknown
        double finishing = 0; // seconds that enlarging the result by first hits, or mixing it with view history, takes
    };
    // After a restart.
    void expect_denoising(const DenoisingTimes& times) { denoising_ = times; }
    // After a restart: first samples begin with kept seeds (LearnedSampling::kept_seeds).
    void expect_seeds() { seeded_ = true; }
    // After a restart: continues from so many samples per pixel, rendered in `seconds`.
    void resume(int64_t samples, double seconds);
    // For changed stop rules of an unchanged image.
    void change_stop_rules(const RenderSettings& settings) { settings_ = settings; }
    // Records that `work` took `seconds`.
    void record_render(const Work& work, double seconds);
    // Records that its frame was published.
    void record_publish() { last_publish_ = seconds_; }
    // Records the estimated relMSE of the current full-resolution image; negative if unknown.
    void record_error(double error);
    // True if the stop rule by error may be met by now, extrapolating the last estimate; then a new estimate is worthwhile.
    bool error_may_be_reached() const { return error_may_be_reached(samples()); }

    bool finished() const;
    // Towards the nearest stop rule, [0, 1]; 1 only when finished.
    double progress() const;
    // Requires that rendering is not finished. `lacks_light_paths`: Renderer::lacks_light_paths().
    Work next(bool lacks_light_paths = false) const;

    int64_t samples() const { return next_sample_ - settings_.first_sample; }
    double seconds() const { return seconds_; }
    const Timings& timings() const { return timings_; }

private:
    int first_divider() const;
    double first_sample_seconds() const;
    int divider_within(double budget, double full_seconds) const;
    bool coarse_image_is_worth_more() const;
    int refined_divider() const;
    double publish_interval() const;
    bool error_may_be_reached(int64_t samples) const;

    RenderSettings settings_;
    Timings timings_;
    int film_divider_ = 0;       // 0: nothing rendered yet
    int last_first_divider_ = 0; // of the first image of the revision before; 0: none
    int64_t coarse_samples_ = 0; // of the film, if it is not at full resolution
    int64_t next_sample_ = 0;
    bool interactive_ = true, seeded_ = false;
    DenoisingTimes denoising_;
    double seconds_ = 0;      // render time of this revision
    double last_publish_ = 0; // seconds_ when last published
    double error_ = -1;       // last estimate, made at
    int64_t error_samples_ = 0;
};

} // namespace blush
