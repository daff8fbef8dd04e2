// Measures the latency from an edit to its first image in a render session.
#pragma once

#include "render/session/render_session.h"
#include "tests/bench/bench.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <random>

namespace blush::bench {

struct Response {
    double first_ms = 0;   // from submit to the first image
    int first_divider = 0; // full size / the size of that image
    double full_ms = 0;    // to the first image of full size
};

// Lets the session refine for a random time.
void render_for_a_while(std::mt19937& random);
// `responses` must not be empty.
Json figures_of(const std::vector<Response>& responses);

class LatencyProbe {
public:
    explicit LatencyProbe(unsigned threads);

    // Submits another scene and waits for its first image of full size; empty if the session failed.
    std::optional<Response> measure(const Scene& scene, const RenderSettings& settings);

private:
    void on_frame(); // on the render thread

    std::mutex mutex_;
    std::condition_variable seen_full_;
    uint64_t revision_ = 0;
    Clock::time_point submitted_;
    Response response_;
    bool failed_ = false;
    RenderSession session_; // last member: its thread uses all the others
};

} // namespace blush::bench
