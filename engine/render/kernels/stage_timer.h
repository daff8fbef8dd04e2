// Measures the stages of a tile, one after the other.
#pragma once

#include "core/ticks.h"
#include "render/film/stage_times.h"

namespace blush {

class StageTimer {
public:
    explicit StageTimer(StageTicks& sums) : sums_(sums), begun_(ticks()) {}
    // The time since the last call, or since construction, belongs to `stage`. `elsewhere`: ticks of it that were counted already.
    void end(Stage stage, int64_t elsewhere = 0) {
        const int64_t now = ticks();
        sums_[stage] += now - begun_ - elsewhere;
        begun_ = now;
    }

private:
    StageTicks& sums_;
    int64_t begun_;
};

// Time within one stage, from a part of its repetitions: a time stamp for each would cost too much.
class SampledTimer {
public:
    static constexpr int stride = 8;

    // For one repetition: null if it is not measured.
    SampledTimer* next() { return count_++ % stride == 0 ? this : nullptr; }
    void begin() { begun_ = ticks(); }
    void end() { sum_ += ticks() - begun_; }
    // Extrapolated to all repetitions.
    int64_t estimate() const { return count_ ? sum_ * count_ / ((count_ + stride - 1) / stride) : 0; }

private:
    int64_t count_ = 0, sum_ = 0, begun_ = 0;
};

} // namespace blush
