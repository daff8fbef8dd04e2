#include "measure/lab/timed_render.h"

#include <algorithm>
#include <chrono>
#include <ctime>

namespace blush {
namespace {

constexpr int64_t least_samples = 2;  // both half buffers need one for an error
constexpr int64_t most_at_once = 256; // samples between two looks at the clock

double seconds_now(bool single_thread) {
    timespec t{};
    if (single_thread && clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t) == 0) return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace

void TimedRender::begin(const RendererOptions& options, const Scene& scene, const RenderSettings& settings) {
    if (!renderer_) {
        renderer_ = std::make_unique<Renderer>(options);
        single_thread_ = options.threads == 1;
    }
    renderer_->update(scene, settings);
    renderer_->clear();
    samples_ = 0;
    seconds_ = 0;
}

bool TimedRender::render(int64_t count, const Wanted& wanted) {
    const double begin = seconds_now(single_thread_);
    if (!renderer_->render(samples_, count, wanted)) return false;
    seconds_ += seconds_now(single_thread_) - begin;
    samples_ += count;
    return true;
}

bool TimedRender::render_until(double goal, const Wanted& wanted) {
    while (samples_ < least_samples || seconds_ < goal) {
        // Half of what fits, and one sample at last: also if the next samples are slower than those before.
        const double left = samples_ > 0 && seconds_ > 0 ? (goal - seconds_) / seconds_ * double(samples_) / 2 : 0;
        const int64_t least = samples_ < least_samples ? least_samples - samples_ : 1;
        if (!render(std::clamp(int64_t(left), least, most_at_once), wanted)) return false;
    }
    return true;
}

std::vector<Vec3> rgb_of(const Frame& frame) {
    std::vector<Vec3> rgb;
    rgb.reserve(frame.rgba.size() / 4);
    for (size_t i = 0; i + 3 < frame.rgba.size(); i += 4) rgb.push_back({frame.rgba[i], frame.rgba[i + 1], frame.rgba[i + 2]});
    return rgb;
}

} // namespace blush
