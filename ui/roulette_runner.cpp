#include "ui/roulette_runner.h"

#include "scene/changes.h"

#include <exception>
#include <utility>

namespace blush {
namespace {

constexpr int64_t most_rounds = 2000; // enough to see a hundredth of a per cent; then it rests

} // namespace

RouletteRunner::RouletteRunner() : thread_([this] { run(); }) {}

RouletteRunner::~RouletteRunner() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void RouletteRunner::measure(const Scene& scene, const RenderSettings& settings) {
    {
        const std::lock_guard lock(mutex_);
        if (last_ && !diff(last_->scene, last_->settings, scene, settings).affects_image()) return;
        last_ = Task{scene, settings};
        pending_ = last_;
        state_ = {};
    }
    wake_.notify_one();
}

RouletteRunner::State RouletteRunner::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

void RouletteRunner::work_once(RouletteLab& lab, const std::optional<Task>& task) {
    State state;
    try {
        if (task) lab.begin(task->scene, task->settings);
        if (!lab.round([this] { return !quit_; })) return;
        state.report = lab.report();
    } catch (const std::exception& e) { state.failure = e.what(); }
    const std::lock_guard lock(mutex_);
    if (!pending_) state_ = std::move(state); // else it answers something that nobody asks any more
}

void RouletteRunner::run() {
    RouletteLab lab({.threads = 1, .low_priority = true, .planes = {}});
    for (;;) {
        std::optional<Task> task;
        {
            std::unique_lock lock(mutex_);
            const auto rests = [&] { return !last_ || !state_.failure.empty() || state_.report.rounds >= most_rounds; };
            wake_.wait(lock, [&] { return quit_ || pending_ || !rests(); });
            if (quit_) return;
            task.swap(pending_);
        }
        work_once(lab, task);
    }
}

} // namespace blush
