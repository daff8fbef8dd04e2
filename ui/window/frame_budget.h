// Time budget of one UI frame: limits the drawing of the image, which can continue later, so that the frame is not late.
#pragma once

#include "ui/window/frame_stats.h"

#include <algorithm>
#include <chrono>

namespace blush {

class FrameBudget {
public:
    using Clock = std::chrono::steady_clock;
    using TimePoint = Clock::time_point;
    // Seconds to the next frame after one that is not drawn, unless there is input.
    static constexpr double unchanged_pause = 1.0 / 120;

    void begin(TimePoint now) { begin_ = image_begun_ = image_done_ = now; }
    void begin_image(TimePoint now) { image_begun_ = image_done_ = now; }
    // Milliseconds that the image may use in a frame of `whole` milliseconds, if the rest of the frame takes as long as
    // recently; always more than 0.
    double left(double whole, TimePoint now) const { return std::max(least, whole - since(begin_, now) - after_image_); }
    void end_image(TimePoint now) { image_done_ = now; }
    // `drawn`: false if the window showed the frame already.
    FrameTimes end(TimePoint now, bool drawn) {
        const FrameTimes times{since(begin_, image_begun_), since(image_begun_, image_done_), since(image_done_, now)};
        if (drawn) after_image_ = std::max(times.after_image, forgetting * after_image_);
        return times;
    }

private:
    static constexpr double least = 2;        // milliseconds: guarantees progress
    static constexpr double forgetting = 0.9; // decay per frame
    static double since(TimePoint from, TimePoint to) { return std::chrono::duration<double, std::milli>(to - from).count(); }

    TimePoint begin_{}, image_begun_{}, image_done_{};
    double after_image_ = 0;
};

} // namespace blush
