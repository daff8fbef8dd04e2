#include "ui/meter_runner.h"

#include "scene/changes.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace blush {
namespace {

constexpr int samples_per_round = 256;
constexpr int64_t least_rounds = 16, most_rounds = 4000;
constexpr double good_enough = 0.002; // half the interval, relative

bool is_good(const MeterReading& r) {
    if (r.rounds >= most_rounds) return true;
    return r.rounds >= least_rounds && r.lux.high - r.lux.low <= 2 * good_enough * r.lux.value;
}

} // namespace

MeterRunner::MeterRunner() : thread_([this] { run(); }) {}

MeterRunner::~MeterRunner() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void MeterRunner::measure(const Scene& scene, const RenderSettings& settings, const std::vector<MeterPlace>& places) {
    Task task{scene, settings, places};
    // Meters stay where they are, wherever it is looked from and at however many pixels.
    task.scene.view = {};
    task.settings.width = task.settings.height = 1;
    task.settings.resolution_scale = 1;
    task.settings.region = {};
    {
        const std::lock_guard lock(mutex_);
        if (last_ && last_->places == places && !diff(last_->scene, last_->settings, task.scene, task.settings).affects_image()) return;
        last_ = std::move(task);
        pending_ = last_;
        state_ = {};
    }
    wake_.notify_one();
}

MeterRunner::State MeterRunner::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

void MeterRunner::work_once(LightMeters& meters, const std::optional<Task>& task) {
    State state;
    try {
        if (task) meters.begin(task->scene, task->settings, task->places);
        if (!meters.round(samples_per_round, [this] { return !quit_; })) return;
        state.readings = meters.readings();
        state.rests = std::ranges::all_of(state.readings, is_good);
    } catch (const std::exception& e) { state.failure = e.what(); }
    const std::lock_guard lock(mutex_);
    if (!pending_) state_ = std::move(state); // else it answers something that nobody asks any more
}

void MeterRunner::run() {
    LightMeters meters({.threads = 1, .low_priority = true, .planes = {}});
    for (;;) {
        std::optional<Task> task;
        {
            std::unique_lock lock(mutex_);
            wake_.wait(lock, [&] { return quit_ || pending_ || (last_ && !state_.rests && state_.failure.empty()); });
            if (quit_) return;
            task.swap(pending_);
        }
        work_once(meters, task);
    }
}

} // namespace blush
