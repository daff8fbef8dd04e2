// Decides when to estimate the error of an image during rendering, from the state and timings it is given. Testable without
// rendering.
#pragma once

#include "core/time_budget.h"
#include "render/frame.h"

#include <cstdint>
#include <vector>

namespace blush {

// Estimates whenever the samples have grown by a tenth, the resolution that a log-log plot and a slope need, while all estimates
// of an image together take at most 0.5 % of its render time; so the first one comes later for larger images. Always estimates
// the final image, an image that a stop rule waits for, and one with a changed light mix, because the mix changes the error.
class ErrorCadence {
public:
    static constexpr double time_share = 0.005; // of rendering
    static constexpr double growth = 1.1;       // of the samples, from one estimate to the next

    struct Source {
        int64_t samples = 0; // per pixel; an estimate needs at least two
        double pixels = 0;
        double seconds = 0;  // of rendering
        bool wanted = false; // estimate at any cost
    };

    // Starts a new image.
    void restart();
    bool due(const Source& image) const;
    // Records an estimate that took so many seconds.
    void record(const Source& image, double seconds);
    // Seconds spent on estimates of this image.
    double spent() const { return budget_.spent(); }

private:
    TimeBudget budget_{time_share};
    int64_t last_samples_ = 0;
};

// The latest error estimate of an image, which frames without their own show as well.
struct LatestEstimate {
    ErrorEstimate error;
    int64_t samples = 0;
    double at = 0; // seconds of rendering
    std::vector<Vec3> gains;

    bool is_of(const Frame& f) const { return samples == f.samples && gains == f.gains; }
    void show_in(Frame& frame) const {
        frame.error = error;
        frame.error_samples = samples;
        frame.error_at = at;
    }
};

} // namespace blush
