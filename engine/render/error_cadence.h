// When to estimate the error of a picture that is being rendered: a pure object, told what there is and how long it took. Tested without
// rendering.
#pragma once

#include "core/time_budget.h"

#include <cstdint>

namespace blush {

// Whenever the samples have grown by a tenth, which is what a log-log plot and a slope can use, if all estimates of an image together take
// at most half a hundredth of the time that it has been rendered for; so the first comes the later, the larger the picture. The picture
// with which rendering ends is always looked at. So is one that a stop rule waits for, and one whose lights were mixed anew: its error is
// another one.
class ErrorCadence {
public:
    static constexpr double time_share = 0.005; // of rendering
    static constexpr double growth = 1.1;       // of the samples, from one estimate to the next

    struct Picture {
        int64_t samples = 0; // per pixel; with fewer than two there is nothing to compare
        double pixels = 0;
        double seconds = 0;  // of rendering
        bool wanted = false; // whatever it costs
    };

    // Another image.
    void restart();
    bool due(const Picture& picture) const;
    // It was estimated, in so many seconds.
    void record(const Picture& picture, double seconds);
    // On estimates of this image so far, seconds.
    double spent() const { return budget_.spent(); }

private:
    TimeBudget budget_{time_share};
    int64_t last_samples_ = 0;
};

} // namespace blush
