#include "tests/render/session/recording_session.h"

#include "tests/support/eventually.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace blush::test {
namespace {

SessionOptions options_with(unsigned threads, DenoiseFunction denoise) {
    SessionOptions options;
    options.threads = threads;
    if (denoise) options.denoiser = [denoise = std::move(denoise)] { return denoise; };
    return options;
}

} // namespace

RecordingSession::RecordingSession(unsigned threads, std::function<void(RenderSession&, const Event&)> on_event, DenoiseFunction denoise)
    : RecordingSession(options_with(threads, std::move(denoise)), std::move(on_event)) {}

RecordingSession::RecordingSession(const SessionOptions& options, std::function<void(RenderSession&, const Event&)> on_event)
    : on_event_(std::move(on_event)) {
    session_ = std::make_unique<RenderSession>(options, [this] { record(); });
    watched_ = session_.get();
}

void RecordingSession::shut_down() {
    const HangGuard guard("the destruction of a session");
    session_.reset();
}

void RecordingSession::record() {
    // Nothing is announced before the first submission, so watched_ is set by now.
    Event event;
    {
        // The render thread and the denoiser's thread announce concurrently: record in the order in which they read the state.
        const std::lock_guard lock(mutex_);
        const Images images = watched_->images();
        event = {watched_->status(), images.frame, images.denoised};
        events_.push_back(event);
    }
    changed_.notify_all();
    if (!on_event_) return;
    const std::lock_guard one_at_a_time(calling_);
    on_event_(*watched_, event);
}

Event RecordingSession::wait_for(const EventTest& test) {
    std::unique_lock lock(mutex_);
    auto found = events_.end();
    const bool came = changed_.wait_for(lock, patience, [&] {
        found = std::find_if(events_.begin(), events_.end(), test);
        return found != events_.end();
    });
    EXPECT_TRUE(came) << "the session never reached the state that the test waits for";
    return came ? *found : Event{};
}

Event RecordingSession::wait_for(uint64_t revision, SessionStatus::State state) {
    return wait_for([=](const Event& e) { return e.status.revision == revision && e.status.state == state; });
}

std::vector<Event> RecordingSession::events() const {
    const std::lock_guard lock(mutex_);
    return events_;
}

std::vector<FramePtr> RecordingSession::frames() const {
    std::vector<FramePtr> frames;
    for (const Event& e : events())
        if (e.frame && (frames.empty() || frames.back() != e.frame)) frames.push_back(e.frame);
    return frames;
}

} // namespace blush::test
