// Work that may take a share of the time that something else takes, and no more.
#pragma once

#include <algorithm>

namespace blush {

// Times are seconds; units are what the work's time is proportional to.
class TimeBudget {
public:
    explicit TimeBudget(double share) : share_(share) {}

    // Another thing is accompanied. What a unit takes is still known.
    void restart() { spent_ = 0; }
    double spent() const { return spent_; }
    double expected(double units) const { return units * per_unit_; }
    // Is there time for that much work, when what it accompanies has taken `elapsed`? Work of a kind never done before is tried.
    bool allows(double units, double elapsed) const { return spent_ + expected(units) <= share_ * elapsed; }
    void record(double units, double seconds) {
        spent_ += seconds;
        if (!(units > 0)) return;
        // What a machine that was busy for a moment took is not what the next will take.
        const double now = seconds / units;
        per_unit_ = per_unit_ > 0 ? 0.5 * (per_unit_ + std::min(now, 2 * per_unit_)) : now;
    }

private:
    double share_;
    double spent_ = 0, per_unit_ = 0; // per_unit_: 0 is not known
};

} // namespace blush
