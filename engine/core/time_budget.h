// Time budget: limits background work to a share of the time of the main work.
#pragma once

#include <algorithm>

namespace blush {

// Times in seconds; the work's time is proportional to its units.
class TimeBudget {
public:
    explicit TimeBudget(double share) : share_(share) {}

    // Starts a new budget for other main work; keeps the measured time per unit.
    void restart() { spent_ = 0; }
    double spent() const { return spent_; }
    double expected(double units) const { return units * per_unit_; }
    // True if the budget allows that much work after `elapsed` seconds of main work. The first work is always allowed, since its
    // time is unknown.
    bool allows(double units, double elapsed) const { return spent_ + expected(units) <= share_ * elapsed; }
    void record(double units, double seconds) {
        spent_ += seconds;
        if (!(units > 0)) return;
        // Smoothed, since a busy machine may distort a single measurement.
        const double now = seconds / units;
        per_unit_ = per_unit_ > 0 ? 0.5 * (per_unit_ + std::min(now, 2 * per_unit_)) : now;
    }

private:
    double share_;
    double spent_ = 0, per_unit_ = 0; // per_unit_: 0 if unknown
};

} // namespace blush
