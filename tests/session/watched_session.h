// A session with a witness: everything that it announces is kept, in order, and can be waited for.
#pragma once

#include "render/render_session.h"

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace blush::test {

// What could be seen at one call of on_frame.
struct Event {
    SessionStatus status;
    FramePtr frame;       // the newest; null before the first
    DenoisedPtr denoised; // of its image, if any
};

using EventTest = std::function<bool(const Event&)>;

class WatchedSession {
public:
    // `on_event` runs at each announcement, after it was recorded, one at a time.
    explicit WatchedSession(unsigned threads = 2, std::function<void(RenderSession&, const Event&)> on_event = {},
                            DenoiseFunction denoise = {});
    explicit WatchedSession(const SessionOptions& options, std::function<void(RenderSession&, const Event&)> on_event = {});

    RenderSession* operator->() { return session_.get(); }
    // Stops and joins; what was announced stays readable.
    void shut_down() { session_.reset(); }

    // The first event for which `test` holds, from the first ever on. A test that waits for more than minutes has failed: returns an empty
    // event.
    Event wait_for(const EventTest& test);
    Event wait_for(uint64_t revision, SessionStatus::State state);
    std::vector<Event> events() const;
    // The events' frames without repetitions, in order of publication.
    std::vector<FramePtr> frames() const;

private:
    void record();

    std::function<void(RenderSession&, const Event&)> on_event_;
    std::mutex calling_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Event> events_;
    RenderSession* watched_ = nullptr;       // the next one, reachable while it is being destroyed
    std::unique_ptr<RenderSession> session_; // last: gone before what its thread writes to
};

} // namespace blush::test
