// Statistics of UI frame times, and of the latency from an edit to the image that shows it.
#pragma once

#include "core/result.h"

#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <vector>

namespace blush {

// The quantile `fraction` of the values (nearest rank); 0 if there are none.
double percentile(std::vector<double> values, double fraction);

// Milliseconds of one UI frame: before the image (input and panels), drawing the rendered image, and after it (remaining
// panels, drawing and swap).
struct FrameTimes {
    double before_image = 0, image = 0, after_image = 0;
    double total() const { return before_image + image + after_image; }
};

class FrameStats {
public:
    using Clock = std::chrono::steady_clock;
    static constexpr double late = 33; // milliseconds: longer frames are noticeable

    // A frame that was displayed at `when`.
    void add_frame(const FrameTimes& times, Clock::time_point when);
    // A frame that was not drawn, because the window showed it already.
    void add_unchanged_frame() { ++unchanged_; }
    // submitted: a revision was submitted in the frame that began at this time. shown: an image of some revision was displayed.
    // An image answers all revisions up to its own. A latency counts from the submission of the image's own revision, a time to
    // an answer from every submission: revisions that are superseded before they have an image have no latency.
    void submitted(uint64_t revision, Clock::time_point when);
    void shown(uint64_t revision, Clock::time_point when);
    void end_frame() { submitted_in_frame_ = 0; }

    // The view settings were changed, and later an image with them was displayed.
    void view_changed(Clock::time_point when) { view_change_begun_ = when; }
    void view_change_shown(Clock::time_point when);

    const std::vector<double>& frames() const { return frames_; }
    const std::vector<double>& latencies() const { return latencies_; }
    const std::vector<double>& answers() const { return answers_; }
    const std::vector<double>& looks() const { return looks_; }
    // {"frames": n, "unchanged_frames": n, "p50_ms", "p95_ms", "max_ms", "late": n, "late_frames": [{"at_s", "before_image_ms",
    // "image_ms", "after_image_ms"}, ...],
    //  "edits": n, "edits_at_once": n, "latency_p50_ms", "latency_p95_ms", "latency_max_ms",
    //  "submissions": n, "answer_p50_ms", "answer_p95_ms", "answer_max_ms",
    //  "looks": n, "look_p50_ms", "look_max_ms"}
    Result<void> write(const std::filesystem::path& file) const;

private:
    struct Submit {
        uint64_t revision;
        Clock::time_point when;
    };
    // Limits memory use in long sessions.
    static void keep(std::vector<double>& values, double value) {
        if (values.size() < (1u << 20)) values.push_back(value);
    }
    std::vector<double> frames_, latencies_, answers_, looks_;
    struct Late {
        Clock::time_point when;
        FrameTimes times;
    };
    std::vector<Late> late_; // the first hundred
    std::optional<Clock::time_point> first_frame_;
    std::optional<Clock::time_point> view_change_begun_;
    std::deque<Submit> unanswered_;
    uint64_t submitted_in_frame_ = 0; // 0: none
    size_t at_once_ = 0, unchanged_ = 0;
};

} // namespace blush
