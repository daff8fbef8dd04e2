// Cost of tracking the error while an image converges, with window settings: recording, measuring images against a reference as
// often as the window does, and estimating the error from the halves. Each should stay below 1 % of the render time.
#include "tests/bench/bench.h"

#include "core/time_budget.h"
#include "measure/convergence/convergence_runs.h"
#include "measure/metrics/image_error.h"
#include "render/session/render_session.h"

#include <condition_variable>
#include <mutex>

namespace blush::bench {
namespace {

// For one image against a reference of its size.
double measuring_seconds(const Frame& frame) {
    MeasuredImage reference;
    reference.image = {frame.width, frame.height, std::vector<Vec3>(frame.rgba.size() / 4, {1, 1, 1})};
    reference.error.resize(frame.rgba.size() / 4);
    const auto begin = Clock::now();
    error_against({frame.rgba, 4}, reference);
    return seconds_since(begin);
}

// A session rendered to its end, whose frames are recorded and measured as they are published.
class RecordedSession {
public:
    explicit RecordedSession(unsigned threads) : session_({.threads = threads, .low_priority = true}, [this] { on_frame(); }) {}

    void run(const Scene& scene, const RenderSettings& settings) {
        std::unique_lock lock(mutex_);
        runs_.begin("run");
        recording_seconds_ = 0;
        measuring_.restart();
        measured_samples_ = measured_ = 0;
        over_ = false;
        session_.submit(++revision_, scene, settings);
        ended_.wait(lock, [&] { return over_; });
    }
    FramePtr last() const { return session_.latest(); }
    size_t points() const { return runs_.live()->record.points().size(); }
    int measured() const { return measured_; }
    double recording_seconds() const { return recording_seconds_; }
    double measuring_seconds() const { return measuring_.spent(); }

private:
    void on_frame() {
        const std::lock_guard lock(mutex_);
        if (const FramePtr frame = session_.latest(); frame && frame->revision == revision_ && frame->divider == 1) {
            const auto begin = Clock::now();
            if (const ConvergencePoint point = estimated_point(*frame); point.rmse.known || point.relmse.known)
                runs_.live()->record.add(point);
            recording_seconds_ += seconds_since(begin);
            measure(*frame);
        }
        const SessionStatus status = session_.status();
        over_ = status.revision == revision_ &&
                (status.state == SessionStatus::State::complete || status.state == SessionStatus::State::failed);
        if (over_) ended_.notify_one();
    }
    void measure(const Frame& frame) {
        const double pixels = double(frame.width) * double(frame.height);
        const bool due = double(frame.samples) >= 1.1 * double(measured_samples_);
        if (!due || !(frame.complete || measuring_.allows(pixels, frame.seconds))) return;
        measuring_.record(pixels, bench::measuring_seconds(frame));
        measured_samples_ = frame.samples;
        ++measured_;
    }

    std::mutex mutex_;
    std::condition_variable ended_;
    bool over_ = false;
    ConvergenceRuns runs_;
    double recording_seconds_ = 0;
    TimeBudget measuring_{max_measuring_share};
    int64_t measured_samples_ = 0;
    int measured_ = 0;
    uint64_t revision_ = 0;
    RenderSession session_; // last member: its thread calls on_frame
};

} // namespace

Json run_recorder(const Options& options) {
    Json results = Json::array();
    for (const BenchScene& scene : options.scenes) {
        RecordedSession session(options.threads);
        RenderSettings settings = window_settings();
        for (const double seconds : {2.0, options.rounds > 2 ? 20.0 : 2.0}) { // the second run knows the cost of an estimate
            settings.seconds = seconds;
            ++settings.seed;
            session.run(scene.scene, settings);
            const FramePtr frame = session.last();
            if (!frame) continue;
            const auto per_cent = [&](double spent) { return rounded(100 * spent / frame->seconds); };
            results.push_back({{"scene", scene.name()},
                               {"seconds", rounded(frame->seconds)},
                               {"points", session.points()},
                               {"measured", session.measured()},
                               {"recording_percent", per_cent(session.recording_seconds())},
                               {"measuring_percent", per_cent(session.measuring_seconds())},
                               {"estimating_percent", per_cent(frame->error_seconds)}});
        }
    }
    return results;
}

} // namespace blush::bench
