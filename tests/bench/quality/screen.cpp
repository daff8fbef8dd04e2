#include "tests/bench/quality/screen.h"

#include <chrono>
#include <thread>

namespace blush::bench {

Screen::Screen(unsigned threads, bool denoised, bool trained)
    : denoised_(denoised), session_({.threads = threads,
                                     .low_priority = true,
                                     .begins_trained = trained,
                                     .denoiser = denoiser_maker(weights_folder(), threads, true)},
                                    [this] { on_frame(); }) {
    session_.want_denoised(denoised);
}

void Screen::on_frame() {
    const auto now = Clock::now();
    const FramePtr frame = session_.latest();
    const std::lock_guard lock(mutex_);
    if (frame && frame->revision == revision_ && first_ms_ == 0) first_ms_ = 1e3 * std::chrono::duration<double>(now - submitted_).count();
    changed_.notify_one();
}

void Screen::submit(const Scene& scene, const RenderSettings& settings) {
    std::unique_lock lock(mutex_);
    const uint64_t revision = ++revision_;
    first_ms_ = 0;
    submitted_ = Clock::now();
    lock.unlock();
    session_.submit(revision, scene, settings);
}

std::string Screen::failure() const {
    const SessionStatus status = session_.status();
    return status.state == SessionStatus::State::failed ? status.message : status.denoiser_failure;
}

bool Screen::shows_full_size() const {
    const auto [frame, denoised] = session_.images();
    if (!frame || frame->revision != revision_ || frame->divider != 1) return false;
    return !denoised_ || (denoised && denoised->divider == 1);
}

Result<void> Screen::show(const Scene& scene, const RenderSettings& settings, double seconds) {
    session_.pause(false);
    submit(scene, settings);
    {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return !failure().empty() || shows_full_size(); });
    }
    if (const std::string why = failure(); !why.empty()) return Error{.what = why};
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    return {};
}

Result<AfterEdit> Screen::edit(const Scene& scene, const RenderSettings& settings, std::span<const double> deadlines) {
    submit(scene, settings);
    AfterEdit after;
    for (const double deadline : deadlines) {
        std::this_thread::sleep_until(submitted_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(deadline)));
        after.images.push_back(session_.images());
    }
    session_.pause(true);
    if (const std::string why = failure(); !why.empty()) return Error{.what = why};
    const std::lock_guard lock(mutex_);
    after.revision = revision_;
    after.first_ms = first_ms_;
    return after;
}

} // namespace blush::bench
