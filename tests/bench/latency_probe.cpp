#include "tests/bench/latency_probe.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace blush::bench {

LatencyProbe::LatencyProbe(unsigned threads) : session_({.threads = threads, .low_priority = true}, [this] { on_frame(); }) {}

void LatencyProbe::on_frame() {
    const auto now = Clock::now();
    const FramePtr frame = session_.latest();
    const bool failed = session_.status().state == SessionStatus::State::failed;
    const std::lock_guard lock(mutex_);
    failed_ = failed;
    if (frame && frame->revision == revision_) {
        const double ms = 1e3 * std::chrono::duration<double>(now - submitted_).count();
        if (response_.first_divider == 0) {
            response_.first_ms = ms;
            response_.first_divider = frame->divider;
        }
        if (frame->divider == 1 && response_.full_ms == 0) response_.full_ms = ms;
    }
    if (failed_ || response_.full_ms > 0) seen_full_.notify_one();
}

std::optional<Response> LatencyProbe::measure(const Scene& scene, const RenderSettings& settings) {
    std::unique_lock lock(mutex_);
    const uint64_t revision = ++revision_;
    response_ = {};
    submitted_ = Clock::now();
    lock.unlock();
    session_.submit(revision, scene, settings);
    lock.lock();
    seen_full_.wait(lock, [&] { return failed_ || response_.full_ms > 0; });
    if (failed_) return std::nullopt;
    return response_;
}

void render_for_a_while(std::mt19937& random) {
    std::this_thread::sleep_for(std::chrono::milliseconds(std::uniform_int_distribution(20, 120)(random)));
}

Json figures_of(const std::vector<Response>& responses) {
    std::vector<double> first, full;
    int coarsest = 1;
    for (const Response& r : responses) {
        first.push_back(r.first_ms);
        full.push_back(r.full_ms);
        coarsest = std::max(coarsest, r.first_divider);
    }
    return {{"first_image_p50_ms", rounded(quantile(first, 0.5))}, {"first_image_p95_ms", rounded(quantile(first, 0.95))},
            {"first_image_max_ms", rounded(quantile(first, 1))},   {"coarsest_divider", coarsest},
            {"full_size_p50_ms", rounded(quantile(full, 0.5))},    {"full_size_p95_ms", rounded(quantile(full, 0.95))}};
}

} // namespace blush::bench
