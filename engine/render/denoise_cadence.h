// When to denoise, and how well: a pure object, told what there is and how long it took. Tested without denoising.
#pragma once

#include "render/denoiser.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

namespace blush {

// An image's first picture in full resolution is denoised at once. After that there is at most one a second, and all of them together
// take at most a tenth of the time that the image has been rendered for. Once nobody has edited for a while the large network is used,
// and the picture with which rendering ends gets the best there is. A coarse picture is denoised if that fits into a frame of the window.
// Times are seconds of any clock that does not jump.
class DenoiseCadence {
public:
    static constexpr double least_interval = 1;       // seconds from the beginning of one to the beginning of the next
    static constexpr double time_share = 0.1;         // of the image's life
    static constexpr double rest_seconds = 2;         // without an edit
    static constexpr double frame_seconds = 1.0 / 30; // for a picture that the window waits for

    // A frame, as far as it matters here.
    struct Source {
        uint64_t image = 0; // another one after each edit that shows
        int64_t samples = 0;
        int divider = 1;
        bool complete = false; // rendering has ended with it
        double megapixels = 0;
    };
    struct Decision {
        std::optional<DenoiseQuality> quality;                 // denoise the newest frame now
        double wait = std::numeric_limits<double>::infinity(); // else: ask again after so many seconds, or when there is something new
    };

    // The newest frame.
    void offer(const Source& source, double now);
    // Is it the first of its image, and will its picture be there within a frame of the window? Then it is worth waiting for.
    bool answers_within_a_frame() const;
    Decision next(double now) const;
    // What next() asked for, of a frame that was the newest at `begun`, ended after `seconds`; `finished`: with a picture.
    void record(const Source& source, DenoiseQuality quality, double begun, double seconds, bool finished);

private:
    bool is_done(DenoiseQuality quality) const;
    bool fits_a_frame() const;
    // Seconds for the newest frame; 0 if nothing was denoised yet.
    double predicted(DenoiseQuality quality) const;

    std::optional<Source> newest_;
    std::array<double, 3> seconds_per_megapixel_{}; // by quality; 0: not known

    // Of the newest frame's image.
    double image_begun_ = 0;
    double spent_ = 0;
    struct Done {
        int64_t samples = 0;
        int divider = 1;
        DenoiseQuality quality = DenoiseQuality::fast;
        double begun = 0;
    };
    std::optional<Done> done_; // the last picture
};

} // namespace blush
