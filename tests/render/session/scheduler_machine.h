// The scheduler's work with simulated timings: no rendering, no clock.
#pragma once

#include "render/session/scheduler.h"

#include <cstddef>
#include <vector>

namespace blush::test {

// A machine with a constant time per sample, whose error falls as 1 / samples.
struct Machine {
    double sample_seconds = 0.01; // every pixel at full resolution
    double error_of_one_sample = 1;

    double seconds(const Work& work) const { return sample_seconds * double(work.count) / (double(work.divider) * double(work.divider)); }

    void do_work(Scheduler& scheduler, const Work& work) const {
        scheduler.record_render(work, seconds(work));
        if (!work.publish && !scheduler.finished()) return;
        scheduler.record_publish();
        if (work.divider == 1) scheduler.record_error(error_of_one_sample / double(scheduler.samples()));
    }
    // Works until finished, or for that many work items.
    std::vector<Work> run(Scheduler& scheduler, size_t pieces = 100000) const {
        std::vector<Work> done;
        while (!scheduler.finished() && done.size() < pieces) {
            done.push_back(scheduler.next());
            do_work(scheduler, done.back());
        }
        return done;
    }
};

inline RenderSettings endless(int width = 1280, int height = 720) {
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    settings.spp = 0;
    return settings;
}

// A scheduler that knows the sample time, before the first work of a new revision.
inline Scheduler trained(const Machine& machine, const RenderSettings& settings) {
    Scheduler scheduler;
    RenderSettings long_ago = settings;
    long_ago.spp = 0;
    scheduler.restart(long_ago, true);
    machine.run(scheduler, 50);
    scheduler.restart(settings, true);
    return scheduler;
}

} // namespace blush::test
