// Light meters at work on a thread of its own, while there are any.
#pragma once

#include "measure/light_meter.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace blush {

class MeterRunner {
public:
    MeterRunner();
    ~MeterRunner(); // gives up the round it is in
    MeterRunner(const MeterRunner&) = delete;
    MeterRunner& operator=(const MeterRunner&) = delete;

    // Starts anew if light at the places may differ from what is measured. Does not wait.
    void measure(const Scene& scene, const RenderSettings& settings, const std::vector<MeterPlace>& places);
    struct State {
        std::vector<MeterReading> readings; // empty until the first round is done
        bool rests = false;                 // they are as good as is of use
        std::string failure;                // why there is nothing to read
    };
    State state() const;

private:
    struct Task {
        Scene scene;
        RenderSettings settings;
        std::vector<MeterPlace> places;
    };
    void run();
    void work_once(LightMeters& meters, const std::optional<Task>& task);

    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::optional<Task> last_, pending_;
    State state_;
    std::atomic<bool> quit_{false};
    std::thread thread_; // last: starts when everything else is there
};

} // namespace blush
