// Render loop: renders samples in growing batches until a stop rule is met or the user interrupts.
#pragma once

#include "render/renderer.h"

#include <atomic>
#include <cstdint>
#include <functional>

namespace blush {

struct LoopProgress {
    int64_t samples = 0; // per pixel, so far
    double seconds = 0;
    double fraction = 0; // progress to the nearest stop rule; 1 only when one is met
    ErrorEstimate error; // the latest estimate
};

struct LoopResult {
    Frame frame;
    int64_t samples = 0;   // per pixel
    double seconds = 0;    // of rendering
    bool complete = false; // a stop rule was met
};

// Number of samples of the next batch, for about a quarter of a second: at most twice the last, at least one, at most `left`.
int64_t next_batch(int64_t last_count, double last_seconds, int64_t left);

// The next sample count, greater than this one, at which the error is estimated for the stop rule: 2, 3, 4, 5, 6, 7, 8, 10, ...
// growing by about a quarter.
int64_t next_error_look(int64_t samples);

// Progress of `samples` and `seconds` to the nearest stop rule of the settings, 0 .. 1; below 1 until one is met.
double stop_progress(const RenderSettings& settings, int64_t samples, double seconds, const ErrorEstimate& error);

// Renders the scene of the renderer's last update, continuing from the samples and seconds of `begin`. `interrupted` is checked
// between batches.
LoopResult run_render_loop(Renderer& renderer, const RenderSettings& settings, const std::atomic<bool>& interrupted,
                           const std::function<void(const LoopProgress&)>& on_progress, const LoopProgress& begin = {});

} // namespace blush
