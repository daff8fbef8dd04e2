// The roulette lab at work on a thread of its own, while somebody looks.
#pragma once

#include "measure/roulette_lab.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace blush {

class RouletteRunner {
public:
    RouletteRunner();
    ~RouletteRunner(); // gives up the round it is in
    RouletteRunner(const RouletteRunner&) = delete;
    RouletteRunner& operator=(const RouletteRunner&) = delete;

    // Starts anew if this differs from what is measured. Does not wait.
    void measure(const Scene& scene, const RenderSettings& settings);
    struct State {
        RouletteReport report;
        std::string failure; // why there is nothing to report
    };
    State state() const;

private:
    struct Task {
        Scene scene;
        RenderSettings settings;
    };
    void run();
    void work_once(RouletteLab& lab, const std::optional<Task>& task);

    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::optional<Task> last_, pending_;
    State state_;
    std::atomic<bool> quit_{false};
    std::thread thread_; // last: starts when everything else is there
};

} // namespace blush
