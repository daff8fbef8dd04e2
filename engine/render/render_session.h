// The one thread that owns everything that renders. Its whole public face.
#pragma once

#include "render/frame.h"
#include "scene/render_settings.h"
#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace blush {

struct SessionOptions {
    unsigned threads = 0;     // 0: one per core
    bool low_priority = true; // below the UI: render threads may not starve it
    bool first_hit_planes = true; // albedo, normal, depth, ids in every frame: picking and the pixel probe read them
};

struct SessionStatus {
    enum class State { idle, updating, rendering, paused, complete, failed };
    State state = State::idle;
    uint64_t revision = 0; // the last one taken up
    double progress = 0;   // towards the nearest stop rule, 0 .. 1; 1 only when reached
    std::string message;   // failed: what went wrong
};

class RenderSession {
public:
    // `on_frame` is called on the render thread after each publication and each change of state; it must not block.
    RenderSession(const SessionOptions& options, std::function<void()> on_frame);
    // Stops in mid-pass if need be, and joins.
    ~RenderSession();
    RenderSession(const RenderSession&) = delete;
    RenderSession& operator=(const RenderSession&) = delete;

    // Replaces whatever was pending; never blocks. Latest wins, but what has been taken up is shown once before the next is. A submit that
    // changes nothing an image shows (stop rules, names) continues it.
    void submit(uint64_t revision, const Scene& scene, const RenderSettings& settings);
    // A paused session still shows the first image of what is submitted, then waits.
    void pause(bool paused);
    // The newest published frame, or null. Never blocks for longer than a pointer copy.
    FramePtr latest() const;
    SessionStatus status() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace blush
