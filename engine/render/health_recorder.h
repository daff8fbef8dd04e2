// The film's memory of what it refused and of what stands out. Tiles report from many threads; what is kept does not depend on their order.
#pragma once

#include "render/health.h"

#include <atomic>
#include <mutex>
#include <vector>

namespace blush {

class HealthRecorder {
public:
    static constexpr size_t remembered = 100;
    static constexpr float least_firefly = 2; // excess: what is less than that is no firefly

    void reset();
    // Samples that were refused, of a film so many pixels wide and in all. Thread-safe.
    void add_dropped(const std::vector<BadSample>& samples, size_t width, size_t pixels);
    // Thread-safe.
    void add_fireflies(const std::vector<Firefly>& samples);
    // Samples of less excess need not be reported: a hundred are worse.
    float least_excess() const { return least_excess_.load(std::memory_order_relaxed); }
    // Goes on from what another recorder has found.
    void restore(const Health& health);
    // Not while tiles report.
    const Health& health() const { return health_; }

    // What one recorder would know that had seen the samples of both.
    static Health merged(const Health& a, const Health& b);

private:
    std::mutex mutex_;
    std::atomic<float> least_excess_{least_firefly};
    Health health_;
};

} // namespace blush
