// From a scene to a finished frame: samples in growing batches until a stop rule is met or the user has had enough.
#pragma once

#include "render/renderer.h"

#include <atomic>
#include <cstdint>
#include <functional>

namespace blush {

struct LoopProgress {
    int64_t samples = 0; // per pixel, so far
    double seconds = 0;
    double fraction = 0; // towards the nearest stop rule; 1 only when one is met
    ErrorEstimate error; // as last looked at
};

struct LoopResult {
    Frame frame;
    int64_t samples = 0;   // per pixel
    double seconds = 0;    // of rendering
    bool complete = false; // a stop rule was met
};

// How many samples to render next so that a batch takes a quarter of a second: at most doubled, at least one, never past `left`.
int64_t next_batch(int64_t last_count, double last_seconds, int64_t left);

// After how many samples, more than these, the error is looked at for the stop rule: 2, 3, 4, 5, 6, 7, 8, 10, ... about every fourth more.
int64_t next_error_look(int64_t samples);

// How far `samples` and `seconds` are towards the nearest of the settings' stop rules, 0 .. 1; below 1 until one is met.
double stop_progress(const RenderSettings& settings, int64_t samples, double seconds, const ErrorEstimate& error);

// Renders what the renderer was last updated with, on from the samples and seconds of `begin`. `interrupted` is looked at between batches.
LoopResult run_render_loop(Renderer& renderer, const RenderSettings& settings, const std::atomic<bool>& interrupted,
                           const std::function<void(const LoopProgress&)>& on_progress, const LoopProgress& begin = {});

} // namespace blush
