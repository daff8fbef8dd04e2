// Decides when to denoise and at which quality, from the state and timings it is given. Testable without denoising.
#pragma once

#include "render/denoise/denoiser.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

namespace blush {

// An image's first full-resolution frame is denoised at once: at half size if the full one would take long, since a frame of one sample
// gains little from it; then at full size as soon as there are two samples. It is denoised again when its samples have doubled, for at
// most half of the image's render time: the second sample shows the bias of the network (bias_correction.h), and soon raw frames would be
// better than the last denoised one. Other frames are denoised at most once per second, all together for at most a tenth of the render
// time. After a while without edits the large network is used, once a quarter of the render time suffices for it: twice the samples are
// worth more. The final frame gets the best quality. A coarse frame is denoised if that fits into one frame of the window, or if it
// refines the one on the screen. Rendering pauses for short runs of the small network: on few cores both at once would delay the
// denoised image by more than the samples are worth. Times are seconds of any monotonic clock.
class DenoiseCadence {
public:
    static constexpr double min_interval = 1;         // seconds from the start of one run to the start of the next
    static constexpr double time_share = 0.1;         // of the image's render time
    static constexpr int64_t renewal_growth = 2;      // of the samples
    static constexpr double renewal_share = 0.5;      // of the image's render time
    static constexpr double max_pause = 1;            // of rendering, for one run
    static constexpr double assumed_speed = 0.25;     // seconds per megapixel of the small network before its first run
    static constexpr double idle_seconds = 2;         // without an edit
    static constexpr double idle_share = 0.25;        // of the image's render time, for all runs with one of the large network
    static constexpr double quick_samples = 2;        // before that many, a frame that takes longer than
    static constexpr double quick_seconds = 0.1;      // is denoised at half size
    static constexpr double refining_seconds = 0.2;   // for a coarse image that refines the denoised one before
    static constexpr double frame_seconds = 1.0 / 30; // for an image that the window waits for

    // The properties of a frame that matter here.
    struct Source {
        uint64_t image = 0; // changes after each edit that affects the image
        int64_t samples = 0;
        int divider = 1;
        bool complete = false; // rendering ended with it
        double megapixels = 0;
        double light_path_share = 1; // Frame::light_path_share
        // A first sample with more of its light paths counts like more samples.
        double amount() const { return double(samples) * light_path_share; }
    };
    struct Decision {
        std::optional<DenoiseQuality> quality;                 // denoise the newest frame now
        bool halves = false;                                   // at half size
        bool pauses_rendering = false;                         // while it runs
        double wait = std::numeric_limits<double>::infinity(); // else: ask again after so many seconds, or when something changes
    };

    // The newest frame.
    void offer(const Source& source, double now);
    // True if it is the first of its image and its denoised image is expected
    // within one frame of the window, so that waiting is worthwhile.
    bool answers_within_a_frame() const;
    Decision next(double now) const;
    // Expected seconds of a run of the small network for a coarse frame, per megapixel; 0 if nothing was denoised yet.
    double coarse_speed() const;
    // The same for a frame of full size.
    double speed() const { return seconds_per_megapixel_[size_t(DenoiseQuality::fast)]; }
    // Records that the run requested by next(), of the newest frame at
    // time `begun`, took `seconds` without preparation of the network; `finished`: it produced an image.
    void record(const Source& source, const Decision& run, double begun, double seconds, bool finished);

private:
    bool is_done(DenoiseQuality quality) const;
    bool fits_a_frame() const;
    bool refines() const;
    Decision now_with(DenoiseQuality quality) const;
    // True if the newest frame is denoised at half size, by the small network.
    bool halves(DenoiseQuality quality) const;
    // Estimated seconds for the newest frame at full size; 0 if nothing was denoised yet.
    double predicted(DenoiseQuality quality) const;
    // The same, at half size if that is due.
    double predicted_run(DenoiseQuality quality) const;

    std::optional<Source> newest_;
    std::array<double, 3> seconds_per_megapixel_{}; // of frames at full resolution, by quality; 0: not known
    double coarse_seconds_per_megapixel_ = 0;       // small network, first coarse frames: they use the cores less well
    double coarse_megapixels_ = 0;                  // of these

    // Of the newest frame's image.
    double image_begun_ = 0;
    double spent_ = 0;
    struct Done {
        double amount = 0; // Source::amount()
        int divider = 1;
        DenoiseQuality quality = DenoiseQuality::fast;
        bool halved = false;
        double begun = 0;
    };
    std::optional<Done> done_; // the last denoised image
};

} // namespace blush
