// What it costs to follow the error while a picture converges, as the window renders. The recorder: recording, and measuring as many pictures
// against a reference as it keeps; to stay below 1 % of the rendering time. Beside it, estimating the error of every frame, which the status
// bar and the stop rules need in any case.
#include "tests/bench/bench.h"

#include "measure/convergence_runs.h"
#include "measure/picture_error.h"
#include "render/render_session.h"

#include <condition_variable>
#include <mutex>

namespace blush::bench {
namespace {

// A session that is rendered to its end, its frames recorded as they come.
class RecordedSession {
public:
    explicit RecordedSession(unsigned threads) : session_({.threads = threads, .low_priority = true}, [this] { on_frame(); }) {}

    void run(const Scene& scene, const RenderSettings& settings) {
        runs_.begin("run");
        session_.submit(1, scene, settings);
        std::unique_lock lock(mutex_);
        ended_.wait(lock, [&] { return over_; });
    }
    FramePtr last() const { return session_.latest(); }
    size_t points() const { return runs_.live()->record.points().size(); }
    double recording_seconds() const { return recording_seconds_; }

private:
    void on_frame() {
        const SessionStatus::State state = session_.status().state;
        const std::lock_guard lock(mutex_);
        const auto begin = Clock::now();
        if (const FramePtr frame = session_.latest(); frame && frame->divider == 1) runs_.live()->record.add(estimated_point(*frame));
        recording_seconds_ += seconds_since(begin);
        over_ = state == SessionStatus::State::complete || state == SessionStatus::State::failed;
        if (over_) ended_.notify_one();
    }

    std::mutex mutex_;
    std::condition_variable ended_;
    bool over_ = false;
    ConvergenceRuns runs_;
    double recording_seconds_ = 0;
    RenderSession session_; // last: its thread calls on_frame
};

// Of one picture against a reference of its size.
double measuring_seconds(const Frame& frame) {
    MeasuredImage reference;
    reference.image = {frame.width, frame.height, std::vector<Vec3>(frame.rgba.size() / 4, {1, 1, 1})};
    reference.error.resize(frame.rgba.size() / 4);
    const auto begin = Clock::now();
    error_against({frame.rgba, 4}, reference);
    return seconds_since(begin);
}

} // namespace

Json run_recorder(const Options& options) {
    Json results = Json::array();
    for (const BenchScene& scene : options.scenes) {
        RenderSettings settings = window_settings();
        settings.spp = 0;
        settings.seconds = options.rounds > 2 ? 20 : 2;
        RecordedSession session(options.threads);
        session.run(scene.scene, settings);
        const FramePtr frame = session.last();
        if (!frame) continue;
        const auto per_cent = [&](double seconds) { return rounded(100 * seconds / frame->seconds); };
        const double measuring = double(session.points()) * measuring_seconds(*frame);
        results.push_back({{"scene", scene.name()},
                           {"seconds", rounded(frame->seconds)},
                           {"points", session.points()},
                           {"recording_percent", per_cent(session.recording_seconds())},
                           {"measuring_percent", per_cent(measuring)},
                           {"recorder_percent", per_cent(session.recording_seconds() + measuring)},
                           {"estimating_percent", per_cent(frame->error_seconds)}});
    }
    return results;
}

} // namespace blush::bench
