#include "app/commands/render/render_loop.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace blush {
namespace {

constexpr double batch_seconds = 0.25;
// No limit on samples; never reached.
constexpr int64_t endless = int64_t(1) << 40;

class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count(); }

private:
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

} // namespace

int64_t next_batch(int64_t last_count, double last_seconds, int64_t left) {
    if (last_count == 0) return std::min<int64_t>(1, left);
    const double per_sample = last_seconds / double(last_count);
    const double fitting = per_sample > 0 ? batch_seconds / per_sample : std::numeric_limits<double>::infinity();
    const int64_t grown = int64_t(std::min(double(2 * last_count), fitting));
    return std::min(std::max<int64_t>(1, grown), left);
}

int64_t next_error_look(int64_t samples) {
    int64_t next = 2;
    while (next <= samples) next = std::max(next + 1, next * 5 / 4);
    return next;
}

double stop_progress(const RenderSettings& settings, int64_t samples, double seconds, const ErrorEstimate& error) {
    double fraction = 0;
    if (settings.spp > 0) fraction = std::max(fraction, double(samples) / double(settings.spp - settings.first_sample));
    if (settings.seconds > 0) fraction = std::max(fraction, seconds / settings.seconds);
    // The MSE is inversely proportional to the number of samples.
    if (settings.error > 0 && error.known)
        fraction = std::max(fraction, error.relmse > settings.error ? settings.error / error.relmse : 1.0);
    return std::min(fraction, 1.0);
}

LoopResult run_render_loop(Renderer& renderer, const RenderSettings& settings, const std::atomic<bool>& interrupted,
                           const std::function<void(const LoopProgress&)>& on_progress, const LoopProgress& begin) {
    const int64_t limit = settings.spp > 0 ? settings.spp - settings.first_sample : endless;
    const Stopwatch watch;
    LoopProgress progress = begin;
    progress.fraction = stop_progress(settings, begin.samples, begin.seconds, begin.error);
    int64_t count = 0, next_measurement = next_error_look(begin.samples);
    double batch_began = begin.seconds;
    while (progress.fraction < 1 && !interrupted) {
        // Error estimates are made at fixed sample counts, independent of time, so that the result is deterministic.
        const int64_t end = settings.error > 0 ? std::min(limit, next_measurement) : limit;
        count = next_batch(count, progress.seconds - batch_began, end - progress.samples);
        batch_began = progress.seconds;
        renderer.render(settings.first_sample + progress.samples, count);
        progress.samples += count;
        // Reads the whole film, so only when the result can have changed.
        if (settings.error > 0 && progress.samples >= next_measurement) {
            progress.error = renderer.estimate_error();
            next_measurement = next_error_look(progress.samples);
        }
        progress.seconds = begin.seconds + watch.seconds();
        progress.fraction = stop_progress(settings, progress.samples, progress.seconds, progress.error);
        on_progress(progress);
    }
    return {renderer.resolve(), progress.samples, progress.seconds, progress.fraction >= 1};
}

} // namespace blush
