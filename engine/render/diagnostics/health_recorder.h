// Records dropped samples and fireflies of a film. Tiles report from many threads; the result does not depend on their order.
#pragma once

#include "render/diagnostics/health.h"

#include <atomic>
#include <mutex>
#include <vector>

namespace blush {

class HealthRecorder {
public:
    static constexpr size_t remembered = 100;
    static constexpr float min_firefly_excess = 2; // minimal excess of a firefly

    void reset();
    // Dropped samples, of a film of `width` and `pixels` in total. Thread-safe.
    void add_dropped(const std::vector<BadSample>& samples, size_t width, size_t pixels);
    // Thread-safe.
    void add_fireflies(const std::vector<Firefly>& samples);
    // Samples with less excess need not be reported: a hundred are worse.
    float min_excess() const { return min_excess_.load(std::memory_order_relaxed); }
    // Continues from the record of another recorder.
    void restore(const Health& health);
    // Not to be called while tiles report.
    const Health& health() const { return health_; }

    // Merges the records of two sets of samples.
    static Health merged(const Health& a, const Health& b);

private:
    std::mutex mutex_;
    std::atomic<float> min_excess_{min_firefly_excess};
    Health health_;
};

} // namespace blush
