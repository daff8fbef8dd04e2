#include "render/render_session.h"

#include "render/frame_pool.h"
#include "render/renderer.h"
#include "render/scheduler.h"
#include "scene/changes.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <utility>

namespace blush {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point a, Clock::time_point b) { return std::chrono::duration<double>(b - a).count(); }

struct Submission {
    uint64_t revision = 0;
    uint64_t image = 0; // counts submissions that ask for another image, not only for other stop rules
    Scene scene;
    RenderSettings settings;
    PlaneSet planes;
    Clock::time_point when;
};

// The number of the image that is asked for: that of `last` if it would look the same and has all the planes.
uint64_t image_number(const std::optional<Submission>& last, const Scene& scene, const RenderSettings& settings, const PlaneSet& planes) {
    if (!last) return 1;
    return last->image + (!last->planes.covers(planes) || diff(last->scene, last->settings, scene, settings).affects_image());
}

// The resolution scale folded into the size.
RenderSettings at_film_size(RenderSettings settings) {
    const auto scaled = [&](int n) { return std::max(1, int(std::lround(double(n) * double(settings.resolution_scale)))); };
    settings.width = scaled(settings.width);
    settings.height = scaled(settings.height);
    settings.resolution_scale = 1;
    return settings;
}

PlaneSet with_first_hits(PlaneSet planes, const SessionOptions& o) {
    if (o.first_hit_planes) planes.albedo = planes.normal = planes.depth = planes.ids = true;
    return planes;
}

} // namespace

struct RenderSession::State {
    SessionOptions options;
    std::function<void()> on_frame;

    std::mutex submitting; // one submission after the other; guards the last one
    std::optional<Submission> last_submitted;

    // Guards the letter box and what the outside may look at.
    mutable std::mutex mutex;
    std::condition_variable wake;
    std::optional<Submission> pending;
    bool paused = false;
    Showcase showcase;
    SessionStatus status;

    // What tiles compare with before they begin: one load, no lock.
    std::atomic<uint64_t> wanted_image{0};
    std::atomic<bool> quit{false};

    // The render thread's own.
    std::optional<Renderer> renderer;
    FramePool frames;
    Submission current;
    Scheduler scheduler;
    std::string failure; // empty: none
    bool has_scene = false, has_first_image = false;
    double first_image_seconds = 0, samples_per_second = 0;
    std::thread thread;

    std::unique_ptr<BackgroundDenoiser> denoiser; // always there; last, so that it goes before what it answers to

    // With the mutex held.
    SessionStatus::State due_state() const;
    bool must_show() const { return has_scene && !has_first_image; }
    bool has_work() const { return due_state() == SessionStatus::State::rendering; }

    void run();
    void announce(std::optional<SessionStatus::State> passing = {});
    void take_up(Submission next);
    void work_once();
    void fail(std::string why);
    void publish(const Work* work = nullptr);
    void take_denoised(uint64_t image, const FramePtr& source, DenoisedPtr denoised);
    Pictures look() const;
};

SessionStatus::State RenderSession::State::due_state() const {
    if (!failure.empty()) return SessionStatus::State::failed;
    if (!has_scene) return SessionStatus::State::idle;
    if (scheduler.finished()) return SessionStatus::State::complete;
    return paused && has_first_image ? SessionStatus::State::paused : SessionStatus::State::rendering;
}

// Tells the outside what state this is, or that it is passing through another one.
void RenderSession::State::announce(std::optional<SessionStatus::State> passing) {
    {
        const std::lock_guard lock(mutex);
        status.state = passing.value_or(due_state());
        status.revision = current.revision;
        status.progress = scheduler.progress();
        status.message = failure;
    }
    on_frame();
}

// Hands out the film as it is; `work` is what was just added to it, if anything.
void RenderSession::State::publish(const Work* work) {
    const std::shared_ptr<Frame> frame = frames.take();
    renderer->resolve(*frame);
    if (work) scheduler.record_publish(*work, frame->error.known ? frame->error.relmse : -1);
    if (!has_first_image) first_image_seconds = seconds_between(current.when, Clock::now());
    has_first_image = true;
    frame->revision = current.revision;
    frame->complete = scheduler.finished();
    frame->seconds = scheduler.seconds();
    frame->first_image_seconds = first_image_seconds;
    frame->samples_per_second = samples_per_second;
    const Pictures previous = look(); // freed without the lock
    const std::lock_guard lock(mutex);
    if (denoiser->offer(current.image, frame))
        showcase.withhold(current.image, frame);
    else
        showcase.show(current.image, frame);
}

// On the denoiser's thread.
void RenderSession::State::take_denoised(uint64_t image, const FramePtr& source, DenoisedPtr denoised) {
    const Pictures previous = look();
    {
        const std::lock_guard lock(mutex);
        if (denoised) status.denoised_with[size_t(denoised->quality)] = true;
        showcase.answer(image, source, std::move(denoised));
        status.denoiser_failure = denoiser->failure();
        if (!status.denoiser_failure.empty()) showcase.release();
    }
    on_frame();
}

Pictures RenderSession::State::look() const {
    const std::lock_guard lock(mutex);
    return showcase.pictures();
}

void RenderSession::State::take_up(Submission next) {
    const bool new_image = next.image != current.image || !has_scene;
    current = std::move(next);
    failure.clear();
    const RenderSettings settings = at_film_size(current.settings);
    if (new_image) {
        has_scene = has_first_image = false;
        scheduler.restart(settings, true);
        announce(SessionStatus::State::updating);
        if (!renderer) renderer.emplace(RendererOptions{options.threads, options.low_priority, {}});
        renderer->set_planes(with_first_hits(current.planes, options));
        renderer->update(current.scene, settings);
        has_scene = true;
    } else {
        scheduler.change_stop_rules(settings);
        renderer->set_planes(with_first_hits(current.planes, options));
        if (has_first_image) publish(); // the same picture answers the new revision
    }
    announce();
}

void RenderSession::State::work_once() {
    const Work work = scheduler.next();
    const uint64_t mine = current.image;
    const auto begin = Clock::now();
    renderer->set_divider(work.divider);
    if (work.clear) renderer->clear();
    const bool done = renderer->render(work.first_sample, work.count, [&] {
        return !quit.load(std::memory_order_relaxed) && (work.always_finish || wanted_image.load(std::memory_order_relaxed) == mine);
    });
    if (!done) return;
    const double seconds = seconds_between(begin, Clock::now());
    samples_per_second = double(work.count) / (std::max(seconds, 1e-9) * work.divider * work.divider);
    scheduler.record_render(work, seconds);
    if (work.publish || scheduler.finished()) publish(&work);
    announce();
}

void RenderSession::State::fail(std::string why) {
    failure = std::move(why);
    has_scene = has_first_image = false;
    renderer.reset(); // what it holds is no longer known to match any scene
    announce();
}

void RenderSession::State::run() {
    for (;;) {
        std::optional<Submission> taken;
        bool work = false;
        {
            std::unique_lock lock(mutex);
            wake.wait(lock, [&] { return quit || pending || has_work() || due_state() != status.state; });
            if (quit) return;
            // What was taken up is shown once before the next is looked at: else a drag faster than the updates would show nothing.
            if (!must_show()) taken.swap(pending);
            work = has_work();
        }
        try {
            if (taken)
                take_up(std::move(*taken));
            else if (work)
                work_once();
            else
                announce();
        } catch (const std::bad_alloc&) { fail("not enough memory"); } catch (const std::exception& e) {
            fail(e.what());
        }
    }
}

RenderSession::RenderSession(const SessionOptions& options, std::function<void()> on_frame) : state_(std::make_unique<State>()) {
    state_->options = options;
    state_->on_frame = on_frame ? std::move(on_frame) : [] {};
    state_->denoiser = std::make_unique<BackgroundDenoiser>(
        options.denoise, [s = state_.get()](uint64_t image, const FramePtr& source, DenoisedPtr denoised) {
            s->take_denoised(image, source, std::move(denoised));
        });
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

void RenderSession::submit(uint64_t revision, const Scene& scene, const RenderSettings& settings, const PlaneSet& planes) {
    State& s = *state_;
    const std::lock_guard submitting(s.submitting);
    s.last_submitted = Submission{revision, image_number(s.last_submitted, scene, settings, planes), scene, settings, planes, Clock::now()};
    std::optional<Submission> next = s.last_submitted;
    {
        const std::lock_guard lock(s.mutex);
        s.wanted_image = next->image;
        s.pending.swap(next);
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

void RenderSession::want_denoised(bool wanted) {
    state_->denoiser->want(wanted);
    if (wanted) return;
    const std::lock_guard lock(state_->mutex);
    state_->showcase.release();
}

Pictures RenderSession::pictures() const { return state_->look(); }

SessionStatus RenderSession::status() const {
    const std::lock_guard lock(state_->mutex);
    return state_->status;
}

} // namespace blush
