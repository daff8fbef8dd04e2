#include "render/render_session.h"

#include "render/renderer.h"
#include "render/scheduler.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace blush {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point a, Clock::time_point b) { return std::chrono::duration<double>(b - a).count(); }

struct Submission {
    uint64_t revision = 0;
    uint64_t image = 0; // counts submissions that ask for another image, not only for other stop rules
    Scene scene;
    RenderSettings settings;
    Clock::time_point when;
};

// The resolution scale folded into the size.
RenderSettings at_film_size(RenderSettings settings) {
    const auto scaled = [&](int n) { return std::max(1, int(std::lround(double(n) * double(settings.resolution_scale)))); };
    settings.width = scaled(settings.width);
    settings.height = scaled(settings.height);
    settings.resolution_scale = 1;
    return settings;
}

RendererOptions renderer_options(const SessionOptions& o) {
    const bool on = o.first_hit_planes;
    return {o.threads, o.low_priority, {on, on, on, on}};
}

} // namespace

struct RenderSession::State {
    SessionOptions options;
    std::function<void()> on_frame;

    // Guarded by the mutex: the letter box and what the outside may look at.
    mutable std::mutex mutex;
    std::condition_variable wake;
    std::optional<Submission> pending;
    std::optional<Submission> last_submitted;
    bool paused = false;
    FramePtr latest;
    SessionStatus status;

    // What tiles compare with before they begin: one load, no lock.
    std::atomic<uint64_t> wanted_image{0};
    std::atomic<bool> quit{false};

    // The render thread's own.
    std::vector<std::shared_ptr<Frame>> frames; // recycled when nobody looks at them any more
    Submission current;
    Scheduler scheduler;
    bool has_scene = false, has_first_image = false, failed = false;
    double first_image_seconds = 0;
    std::thread thread;

    void set_status(SessionStatus::State state, std::string message = {}) {
        {
            const std::lock_guard lock(mutex);
            status.state = state;
            status.revision = current.revision;
            status.progress = scheduler.progress();
            status.message = std::move(message);
        }
        on_frame();
    }
    bool has_work() const { return has_scene && !failed && !scheduler.finished() && !(paused && has_first_image); }

    void run();
    void take_up(Renderer& renderer, Submission next);
    void work_once(Renderer& renderer);
    std::shared_ptr<Frame> unused_frame();
};

std::shared_ptr<Frame> RenderSession::State::unused_frame() {
    for (const auto& frame : frames)
        if (frame.use_count() == 1) return frame;
    frames.push_back(std::make_shared<Frame>());
    return frames.back();
}

void RenderSession::State::take_up(Renderer& renderer, Submission next) {
    const bool new_image = next.image != current.image || !has_scene;
    current = std::move(next);
    failed = false;
    const RenderSettings settings = at_film_size(current.settings);
    if (new_image) {
        set_status(SessionStatus::State::updating);
        renderer.update(current.scene, settings);
        scheduler.restart(settings, true);
        has_first_image = false;
    } else {
        scheduler.change_stop_rules(settings);
    }
    has_scene = true;
    if (scheduler.finished()) set_status(SessionStatus::State::complete);
}

void RenderSession::State::work_once(Renderer& renderer) {
    const Work work = scheduler.next();
    const uint64_t mine = current.image;
    const auto begin = Clock::now();
    renderer.set_divider(work.divider);
    if (work.clear) renderer.clear();
    const bool done = renderer.render(work.first_sample, work.count, [&] {
        return !quit.load(std::memory_order_relaxed) && (work.always_finish || wanted_image.load(std::memory_order_relaxed) == mine);
    });
    if (!done) return;
    const auto rendered = Clock::now();
    const double seconds = seconds_between(begin, rendered);
    scheduler.record_render(work, seconds);
    std::shared_ptr<Frame> frame;
    if (work.publish || scheduler.finished()) {
        frame = unused_frame();
        renderer.resolve(*frame);
    }
    const auto resolved = Clock::now();
    if (frame) scheduler.record_publish(work, seconds_between(rendered, resolved), frame->error.known ? frame->error.relmse : -1);
    if (!has_first_image) first_image_seconds = seconds_between(current.when, resolved);
    has_first_image = true;
    if (frame) {
        frame->revision = current.revision;
        frame->complete = scheduler.finished();
        frame->seconds = scheduler.seconds();
        frame->first_image_seconds = first_image_seconds;
        frame->samples_per_second = double(work.count) / (std::max(seconds, 1e-9) * work.divider * work.divider);
        const std::lock_guard lock(mutex);
        latest = frame;
    }
    set_status(scheduler.finished() ? SessionStatus::State::complete : SessionStatus::State::rendering);
}

void RenderSession::State::run() {
    std::optional<Renderer> renderer;
    for (;;) {
        std::optional<Submission> taken;
        {
            std::unique_lock lock(mutex);
            if (!quit && !pending && paused && has_first_image && status.state == SessionStatus::State::rendering)
                status.state = SessionStatus::State::paused;
            wake.wait(lock, [&] { return quit || pending || has_work(); });
            if (quit) return;
            taken.swap(pending);
        }
        try {
            if (!renderer) renderer.emplace(renderer_options(options));
            if (taken) take_up(*renderer, std::move(*taken));
            else work_once(*renderer);
        } catch (const std::exception& e) {
            failed = true;
            set_status(SessionStatus::State::failed, e.what());
            renderer.reset(); // what it holds is no longer known to match any scene
            has_scene = false;
        }
    }
}

RenderSession::RenderSession(const SessionOptions& options, std::function<void()> on_frame) : state_(std::make_unique<State>()) {
    state_->options = options;
    state_->on_frame = on_frame ? std::move(on_frame) : [] {};
    state_->thread = std::thread([s = state_.get()] { s->run(); });
}

RenderSession::~RenderSession() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->quit = true;
    }
    state_->wake.notify_one();
    state_->thread.join();
}

void RenderSession::submit(uint64_t revision, const Scene& scene, const RenderSettings& settings) {
    State& s = *state_;
    {
        const std::lock_guard lock(s.mutex);
        Submission next{revision, 1, scene, settings, Clock::now()};
        if (s.last_submitted) {
            const Submission& last = *s.last_submitted;
            const bool same = last.scene == scene && same_image(last.settings, settings);
            next.image = last.image + !same;
        }
        s.last_submitted = next;
        s.wanted_image = next.image;
        s.pending = std::move(next);
    }
    s.wake.notify_one();
}

void RenderSession::pause(bool paused) {
    {
        const std::lock_guard lock(state_->mutex);
        state_->paused = paused;
    }
    state_->wake.notify_one();
}

FramePtr RenderSession::latest() const {
    const std::lock_guard lock(state_->mutex);
    return state_->latest;
}

SessionStatus RenderSession::status() const {
    const std::lock_guard lock(state_->mutex);
    return state_->status;
}

} // namespace blush
