// A session that records all of its announcements, in order; tests can wait for them.
#pragma once

#include "render/session/render_session.h"

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace blush::test {

// The published state at one call of on_frame.
struct Event {
    SessionStatus status;
    FramePtr frame;       // the latest; null before the first
    DenoisedPtr denoised; // of its image, if any
};

using EventTest = std::function<bool(const Event&)>;

class RecordingSession {
public:
    // `on_event` runs for each announcement after it was recorded, one at a time.
    explicit RecordingSession(unsigned threads = 2, std::function<void(RenderSession&, const Event&)> on_event = {},
                              DenoiseFunction denoise = {});
    explicit RecordingSession(const SessionOptions& options, std::function<void(RenderSession&, const Event&)> on_event = {});

    RenderSession* operator->() { return session_.get(); }
    ~RecordingSession() { shut_down(); }
    // Stops and joins; recorded events stay readable. A session that never ends aborts the test with a message.
    void shut_down();

    // Returns the first recorded event for which `test` holds. After minutes the test fails and an empty event is returned.
    Event wait_for(const EventTest& test);
    Event wait_for(uint64_t revision, SessionStatus::State state);
    std::vector<Event> events() const;
    // The distinct frames of the events, in order of publication.
    std::vector<FramePtr> frames() const;

private:
    void record();

    std::function<void(RenderSession&, const Event&)> on_event_;
    std::mutex calling_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Event> events_;
    RenderSession* watched_ = nullptr;       // the session, accessible during its destruction
    std::unique_ptr<RenderSession> session_; // last member: destroyed before the members that its thread writes to
};

} // namespace blush::test
