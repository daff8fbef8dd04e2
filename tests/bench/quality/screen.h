// The images that the window shows after an edit, at given times: a session as the window has it, refining the scene of before.
#pragma once

#include "render/session/render_session.h"
#include "tests/bench/bench.h"

#include <condition_variable>
#include <mutex>
#include <span>
#include <vector>

namespace blush::bench {

struct AfterEdit {
    uint64_t revision = 0;      // of the edited scene
    double first_ms = 0;        // from the edit to its first image; 0: none before the last deadline
    std::vector<Images> images; // at each deadline: those of before the edit if there was no other
};

class Screen {
public:
    // `denoised`: denoised images are wanted, as after N in the window. `trained`: SessionOptions::begins_trained.
    Screen(unsigned threads, bool denoised, bool trained = true);

    // Shows the scene at full size, denoised if wanted, and refines it for `seconds`. Errors: those of the session.
    Result<void> show(const Scene& scene, const RenderSettings& settings, double seconds);
    // Submits the edited scene and records the displayed images at each of the `deadlines`, ascending seconds after the edit; it keeps the
    // frames and copies no pixels, so that it does not disturb the session. Then the session pauses until the next show().
    Result<AfterEdit> edit(const Scene& scene, const RenderSettings& settings, std::span<const double> deadlines);

private:
    void on_frame(); // on the session's threads
    void submit(const Scene& scene, const RenderSettings& settings);
    std::string failure() const;
    bool shows_full_size() const;

    bool denoised_;
    std::mutex mutex_;
    std::condition_variable changed_;
    uint64_t revision_ = 0;
    Clock::time_point submitted_;
    double first_ms_ = 0;
    RenderSession session_; // last member: its threads use all the others
};

} // namespace blush::bench
