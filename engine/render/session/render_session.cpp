#include "render/session/render_session.h"

#include "render/renderer.h"
#include "render/session/error_cadence.h"
#include "render/session/first_hit_sharing.h"
#include "render/session/frame_pool.h"
#include "render/session/pause_gate.h"
#include "render/session/scheduler.h"

#include <algorithm>
#include <atomic>
#include <chrono>
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

constexpr double idle_seconds = 1; // without a submission, until light selection follows the mix

double seconds_between(Clock::time_point a, Clock::time_point b) { return std::chrono::duration<double>(b - a).count(); }

// A submission that the render thread has not applied yet.
struct PendingSubmission {
    SubmissionPtr content;
    FilmStatePtr film; // to continue from; null: none
    Clock::time_point when;
};

} // namespace

struct RenderSession::State {
    SessionOptions options;
    std::function<void()> on_frame;

    std::mutex submitting; // serialises submissions; guards last_submitted and last_content
    SubmissionPtr last_submitted;
    LastContent last_content; // of last_submitted, or newer without differences from it

    // Guards the pending submission and the published state.
    mutable std::mutex mutex;
    std::condition_variable wake;
    std::optional<PendingSubmission> pending;
    bool paused = false;
    bool lacks_planes = false;          // the shown frame, because the denoiser was off
    std::optional<uint64_t> film_asked; // revision of the requested film
    std::optional<RequestedFilm> kept_film;
    PublishedFrames published_frames;
    SessionStatus status;

    // Read by tiles before they begin: one load, no lock.
    std::atomic<uint64_t> wanted_image{0};
    std::atomic<bool> quit{false};
    std::atomic<bool> film_wanted{false}; // film_asked holds a value
    PauseGate gate;                       // closed while rendering yields to the UI

    // Used only by the render thread.
    std::optional<Renderer> renderer;
    FramePool frames;
    SubmissionPtr current = std::make_shared<const Submission>();
    Clock::time_point submitted_at; // current
    Scheduler scheduler;
    std::string failure, restart_reason; // empty: none
    bool has_scene = false, has_first_image = false;
    bool selects_lights_by_mix = false; // light selection follows the current mix
    double first_image_seconds = 0, samples_per_second = 0;
    FirstHitSharing first_hits;
    ErrorCadence error_cadence;
    LatestEstimate estimated; // of this image
    std::thread thread;

    // always set; last member, so that it is destroyed before the members that its callbacks use
    std::unique_ptr<BackgroundDenoiser> denoiser;

    // Requires the mutex.
    SessionStatus::State due_state() const;
    bool must_show() const { return has_scene && !has_first_image; }
    // Rendering pauses between batches for the denoiser, not between tiles: the denoiser would lack a worker that waits in a tile.
    bool has_work() const { return due_state() == SessionStatus::State::rendering && !(has_first_image && denoiser->pauses_rendering()); }
    bool yields_to_ui() const { return gate.is_closed() && has_first_image && !(pending && pending->content->image != current->image); }

    SubmissionPtr submit(uint64_t revision, const SubmissionContent& content, Changes changes, FilmStatePtr film);
    PlaneSet wanted_planes() const;
    void run();
    void announce(std::optional<SessionStatus::State> passing = {});
    void apply_submission(PendingSubmission next);
    void begin_image(const RenderSettings& film_settings, const FilmState* film);
    void render_batch();
    void fail(std::string why, std::optional<uint64_t> asked);
    void go_on_from(const FilmState& film);
    std::shared_ptr<Frame> resolved(bool wants_error = false);
    void estimate_error(Frame& frame, bool wanted);
    void publish();
    void mix_denoised(const Frame& frame);
    void request_film(uint64_t revision);
    void answer(RequestedFilm kept);
    void receive_denoised(uint64_t image, const FramePtr& source, DenoisedPtr denoised);
    void on_networks_freed();
    Images current_images() const;
};

SessionStatus::State RenderSession::State::due_state() const {
    if (!failure.empty()) return SessionStatus::State::failed;
    if (!has_scene) return SessionStatus::State::idle;
    if (scheduler.finished()) return SessionStatus::State::complete;
    if (paused && has_first_image) return SessionStatus::State::paused;
    return yields_to_ui() ? SessionStatus::State::yielding : SessionStatus::State::rendering;
}

PlaneSet RenderSession::State::wanted_planes() const {
    PlaneSet planes = current->planes;
    if (options.first_hit_planes) planes.albedo = planes.normal = planes.depth = planes.ids = true;
    planes.half_difference = denoiser->is_on();
    return planes;
}

// Publishes the current state, or a transient one.
void RenderSession::State::announce(std::optional<SessionStatus::State> passing) {
    {
        const std::lock_guard lock(mutex);
        status.state = passing.value_or(due_state());
        status.revision = current->revision;
        status.progress = scheduler.progress();
        status.message = failure;
        status.restart_reason = restart_reason;
    }
    on_frame();
}

// Keeps the cost negligible, unless an estimate is requested.
void RenderSession::State::estimate_error(Frame& frame, bool wanted) {
    const bool mixed_anew = estimated.samples > 0 && estimated.gains != frame.gains;
    const ErrorCadence::Source image{frame.samples, double(frame.width) * double(frame.height), frame.seconds,
                                     wanted || mixed_anew || scheduler.finished() || scheduler.error_may_be_reached()};
    if (frame.divider == 1 && !estimated.is_of(frame) && error_cadence.due(image)) {
        const auto begin = Clock::now();
        estimated = {renderer->estimate_error(), frame.samples, frame.seconds, frame.gains};
        error_cadence.record(image, seconds_between(begin, Clock::now()));
        scheduler.record_error(estimated.error.known ? estimated.error.relmse : -1);
    }
    estimated.show_in(frame);
    frame.error_seconds = error_cadence.spent();
}

std::shared_ptr<Frame> RenderSession::State::resolved(bool wants_error) {
    std::shared_ptr<Frame> frame = frames.take();
    renderer->set_planes(wanted_planes()); // the denoiser may have been switched
    renderer->resolve(*frame);
    frame->revision = current->revision;
    frame->look = current->look;
    frame->camera = frame->whole && renderer->has_sharp_first_hits() ? std::optional(renderer->world_camera()) : std::nullopt;

    frame->seconds = scheduler.seconds();
    estimate_error(*frame, wants_error);
    frame->complete = scheduler.finished();
    frame->first_image_seconds = first_image_seconds;
    frame->samples_per_second = samples_per_second;
    return frame;
}

// Remixes denoised groups without denoising again.
void RenderSession::State::mix_denoised(const Frame& frame) {
    const DenoisedPtr before = current_images().denoised;
    if (!before || !before->groups || before->gains == frame.gains || frame.light_groups != before->groups->of) return;
    DenoisedPtr after = remixed(*before, frame.gains);
    const std::lock_guard lock(mutex);
    published_frames.replace(before, std::move(after));
}

// Publishes the film as it is.
void RenderSession::State::publish() {
    const std::shared_ptr<Frame> frame = resolved();
    if (options.first_hit_planes && denoiser->is_on())
        first_hits.share(*renderer, frame, has_first_image);
    else
        renderer->keep_first_hits(nullptr);
    mix_denoised(*frame);
    if (!has_first_image) first_image_seconds = seconds_between(submitted_at, Clock::now());
    has_first_image = true;
    frame->first_image_seconds = first_image_seconds;
    const Images previous = current_images(); // freed after unlocking
    const std::lock_guard lock(mutex);
    if (denoiser->offer(current->image, frame))
        published_frames.withhold(current->image, frame);
    else
        published_frames.show(current->image, frame);
}

// Called on the denoiser's thread.
void RenderSession::State::receive_denoised(uint64_t image, const FramePtr& source, DenoisedPtr denoised) {
    const Images previous = current_images();
    // The mix may have changed during denoising.
    if (denoised && denoised->groups && previous.frame && previous.frame->light_groups == denoised->groups->of)
        if (previous.frame->gains != denoised->gains) denoised = remixed(*denoised, previous.frame->gains);
    {
        const std::lock_guard lock(mutex);
        if (denoised) status.denoised_with[size_t(denoised->quality)] = true;
        published_frames.answer(image, source, std::move(denoised));
        status.denoiser_failure = denoiser->failure();
        if (!status.denoiser_failure.empty()) published_frames.release();
    }
    wake.notify_one(); // rendering may have paused for it
    on_frame();
}

// Called on the denoiser's thread after its networks were freed.
void RenderSession::State::on_networks_freed() {
    {
        const std::lock_guard lock(mutex);
        status.denoised_with = {};
    }
    on_frame();
}

Images RenderSession::State::current_images() const {
    const std::lock_guard lock(mutex);
    return published_frames.images();
}

void RenderSession::State::begin_image(const RenderSettings& film_settings, const FilmState* film) {
    has_scene = has_first_image = false;
    error_cadence.restart();
    estimated = {};
    scheduler.restart(film_settings, true);
    announce(SessionStatus::State::updating);
    if (!renderer)
        renderer.emplace(RendererOptions{
            .threads = options.threads, .low_priority = options.low_priority, .planes = {}, .begins_trained = options.begins_trained});
    renderer->set_planes(wanted_planes());
    renderer->begin_image(current->base(), film_settings, current->groups);
    if (current->groups) renderer->set_mix(current->mixing);
    const double planes = current->groups ? double(current->groups->groups.size()) : 1; // light groups are denoised separately
    scheduler.expect_denoising({1e-6 * planes * denoiser->coarse_speed(), 1e-6 * planes * denoiser->speed(),
                                denoiser->finishing_seconds(FirstHitSharing::knows(*renderer), current->look)});
    if (renderer->begins_with_seeds()) scheduler.expect_seeds();
    has_scene = true;
    restart_reason.clear();
    if (film) go_on_from(*film);
}

void RenderSession::State::apply_submission(PendingSubmission next) {
    const bool new_image = next.content->image != current->image || !has_scene;
    current = std::move(next.content);
    submitted_at = next.when;
    failure.clear();
    const RenderSettings settings = at_film_size(current->settings);
    if (new_image) {
        begin_image(settings, next.film.get());
    } else {
        scheduler.change_stop_rules(settings);
        renderer->set_planes(wanted_planes());
        if (current->groups) renderer->set_mix(current->mixing);
        if (scheduler.finished() && has_first_image) renderer->settle_first_sample();
        if (has_first_image) publish(); // the unchanged image answers the new revision
    }
    selects_lights_by_mix = false;
    announce();
}

void RenderSession::State::go_on_from(const FilmState& film) {
    if (const auto loaded = renderer->load_film(film); !loaded) {
        restart_reason = loaded.error().text();
        return;
    }
    scheduler.resume(film.samples, film.seconds);
    publish();
}

void RenderSession::State::request_film(uint64_t revision) {
    RequestedFilm kept{.revision = revision};
    Result<FilmState> film = Error{"", "the image changed before its film was saved", ""};
    if (renderer && has_first_image && revision == current->revision && renderer->settle_first_sample())
        film = renderer->save_film(current->settings.first_sample);
    if (film) {
        film->seconds = scheduler.seconds();
        kept.frame = resolved(true);
        kept.error = renderer->resolve_error();
        kept.film = std::make_shared<const FilmState>(*std::move(film));
    } else {
        kept.why_none = film.error().text();
    }
    answer(std::move(kept));
    announce();
}

void RenderSession::State::answer(RequestedFilm kept) {
    const std::lock_guard lock(mutex);
    kept_film = std::move(kept);
}

void RenderSession::State::render_batch() {
    if (current->groups && !selects_lights_by_mix && seconds_between(submitted_at, Clock::now()) > idle_seconds) {
        renderer->select_lights_by_mix();
        selects_lights_by_mix = true;
    }
    const Work work = scheduler.next(renderer->lacks_light_paths());
    const uint64_t mine = current->image;
    const std::function<bool()> interrupted = [&] {
        return work.always_finish || quit.load(std::memory_order_relaxed) || film_wanted.load(std::memory_order_relaxed) ||
               wanted_image.load(std::memory_order_relaxed) != mine;
    };
    const std::function<bool()> wanted = [&] {
        gate.wait_while_closed(interrupted);
        return !quit.load(std::memory_order_relaxed) &&
               (work.always_finish || film_wanted.load(std::memory_order_relaxed) || wanted_image.load(std::memory_order_relaxed) == mine);
    };
    // Not within the time of the samples, from which that of the next image is predicted.
    const int64_t end = work.first_sample + work.count;
    if (work.decides && !(work.clear ? renderer->decide_first_sample(wanted) : renderer->decide(wanted, end))) return;
    const auto begin = Clock::now();
    const double shut_before = gate.closed_seconds();
    renderer->set_divider(work.divider);
    if (work.clear) renderer->clear();
    if (!(work.completes ? renderer->add_light_paths(wanted) : renderer->render(work.first_sample, work.count, wanted))) return;
    const double seconds = seconds_between(begin, Clock::now()) - (gate.closed_seconds() - shut_before);
    if (work.count > 0) samples_per_second = double(work.count) / (std::max(seconds, 1e-9) * work.divider * work.divider);
    scheduler.record_render(work, seconds);
    if (scheduler.finished() && !renderer->settle_first_sample(wanted)) return;
    if (work.publish || scheduler.finished()) {
        publish();
        scheduler.record_publish();
    }
    announce();
}

void RenderSession::State::fail(std::string why, std::optional<uint64_t> asked) {
    failure = std::move(why);
    if (asked) answer({.revision = *asked, .why_none = failure});
    has_scene = has_first_image = false;
    renderer.reset(); // its state may no longer match any scene
    announce();
}

void RenderSession::State::run() {
    for (;;) {
        std::optional<PendingSubmission> taken;
        std::optional<uint64_t> asked;
        bool work = false, resolve_again = false;
        {
            std::unique_lock lock(mutex);
            wake.wait(lock, [&] {
                return quit || film_asked || (pending && !yields_to_ui()) || has_work() || lacks_planes || due_state() != status.state;
            });
            if (quit) return;
            // Before the requested image is replaced.
            asked = std::exchange(film_asked, std::nullopt);
            film_wanted = false;
            // Show an applied submission once before applying the next:
            // otherwise a drag faster than the updates would show nothing.
            if (!asked && !must_show() && !yields_to_ui()) taken.swap(pending);
            work = has_work();
            resolve_again = std::exchange(lacks_planes, false) && has_first_image;
        }
        try {
            if (asked)
                request_film(*asked);
            else if (taken)
                apply_submission(std::move(*taken));
            else if (work)
                render_batch();
            else if (resolve_again)
                publish();
            else
                announce();
        } catch (const std::bad_alloc&) { fail("not enough memory", asked); } catch (const std::exception& e) {
            fail(e.what(), asked);
        }
    }
}

// Requires `submitting`.
SubmissionPtr RenderSession::State::submit(uint64_t revision, const SubmissionContent& content, Changes changes, FilmStatePtr film) {
    const SubmissionPtr next = next_submission(last_submitted.get(), revision, content, std::move(changes), film != nullptr);
    last_submitted = next;
    last_content.keep(content);
    std::optional<PendingSubmission> replaced; // freed after unlocking
    {
        const std::lock_guard lock(mutex);
        wanted_image = next->image;
        // Samples of a pending submission belong to this image too.
        if (!film && pending && pending->content->image == next->image) film = pending->film;
        replaced = std::exchange(pending, PendingSubmission{next, std::move(film), Clock::now()});
    }
    denoiser->supersede(next->image);
    gate.notify();
    wake.notify_one();
    return next;
}

RenderSession::RenderSession(const SessionOptions& options, std::function<void()> on_frame) : state_(std::make_unique<State>()) {
    state_->options = options;
    state_->on_frame = on_frame ? std::move(on_frame) : [] {};
    state_->denoiser = std::make_unique<BackgroundDenoiser>(
        options.denoiser, options.threads, options.low_priority, options.denoiser_grace, state_->gate,
        [s = state_.get()](uint64_t image, const FramePtr& source, DenoisedPtr denoised) {
            s->receive_denoised(image, source, std::move(denoised));
        },
        [s = state_.get()] { s->on_networks_freed(); });
    state_->thread = std::thread([s = state_.get()] { s->run(); });
}

RenderSession::~RenderSession() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->quit = true;
    }
    state_->gate.notify();
    state_->wake.notify_one();
    state_->thread.join();
}

SubmissionPtr RenderSession::submit(uint64_t revision, const Scene& scene, const RenderSettings& settings, const PlaneSet& planes,
                                    FilmStatePtr film) {
    const std::lock_guard submitting(state_->submitting);
    const SubmissionContent content{scene, settings, planes};
    return state_->submit(revision, content, state_->last_content.changes_to(content), std::move(film));
}

SubmissionPtr RenderSession::submit_changes(uint64_t revision, const Scene& scene, const RenderSettings& settings, const PlaneSet& planes) {
    const std::lock_guard submitting(state_->submitting);
    const SubmissionContent content{scene, settings, planes};
    const Submission* last = state_->last_submitted.get();
    Changes changes = state_->last_content.changes_to(content);
    if (last && !changes.any() && planes == last->planes) {
        state_->last_content.keep(content);
        return nullptr;
    }
    return state_->submit(revision, content, std::move(changes), nullptr);
}

void RenderSession::request_film(uint64_t revision) {
    {
        const std::lock_guard lock(state_->mutex);
        state_->film_asked = revision;
        state_->film_wanted = true;
    }
    state_->gate.notify();
    state_->wake.notify_one();
}

std::optional<RequestedFilm> RenderSession::take_requested_film() {
    const std::lock_guard lock(state_->mutex);
    return std::exchange(state_->kept_film, std::nullopt);
}

void RenderSession::pause(bool paused) {
    {
        const std::lock_guard lock(state_->mutex);
        state_->paused = paused;
    }
    state_->wake.notify_one();
}

void RenderSession::yield_to_ui(bool yielding) {
    if (yielding) return state_->gate.close();
    {
        const std::lock_guard lock(state_->mutex); // ensures that the thread is not between its check and its wait
        state_->gate.open();
    }
    state_->wake.notify_one();
}

void RenderSession::want_denoised(bool wanted) {
    state_->denoiser->want(wanted);
    {
        const std::lock_guard lock(state_->mutex);
        const FramePtr& shown = state_->published_frames.images().frame;
        state_->lacks_planes = wanted && shown && shown->samples > 1 && shown->half_difference.empty();
        if (!wanted) state_->published_frames.release();
    }
    state_->wake.notify_one(); // rendering may have paused for a denoised image
}

Images RenderSession::images() const { return state_->current_images(); }

SessionStatus RenderSession::status() const {
    const std::lock_guard lock(state_->mutex);
    SessionStatus status = state_->status;
    if (status.state == SessionStatus::State::rendering && state_->gate.has_waiting_threads())
        status.state = SessionStatus::State::yielding;
    return status;
}

} // namespace blush
