// Error against run time: what is recorded while a picture converges, and what a series of such records says.
#pragma once

#include "measure/intervals.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

enum class ErrorMetric { rmse, relmse };
enum class ProgressAxis { seconds, spp };

// The error of a picture at one moment.
struct ConvergencePoint {
    enum class Kind {
        estimated, // of the raw picture, from its two halves
        measured,  // of the raw picture, against a reference
        denoised,  // of the denoised one, against a reference or, less surely, against the raw picture later on
    };
    Kind kind = Kind::estimated;
    double seconds = 0; // of rendering, measuring not included
    int64_t spp = 0;
    Interval rmse, relmse; // value but not `known`: no interval

    double at(ProgressAxis axis) const { return axis == ProgressAxis::seconds ? seconds : double(spp); }
    const Interval& error(ErrorMetric metric) const { return metric == ErrorMetric::rmse ? rmse : relmse; }
};
std::string_view to_string(ConvergencePoint::Kind kind); // "estimated", "measured", "denoised"

// A moment worth a mark in the plot: an edit, a change of settings.
struct ConvergenceMark {
    double seconds = 0;
    int64_t spp = 0;
    std::string label;
    bool other_mix = false; // points before it are of the same samples mixed in another way: no slope is told from them

    double at(ProgressAxis axis) const { return axis == ProgressAxis::seconds ? seconds : double(spp); }
};

// The curves of one run. Points are kept when the samples have grown by a tenth since the last one of their kind: evenly in a log-log
// plot, and about two hundred of them however long it runs.
class ConvergenceRecord {
public:
    std::string name;

    // Would add() keep a point of this kind?
    bool is_due(ConvergencePoint::Kind kind, int64_t spp) const;
    // False if the point was left out.
    bool add(const ConvergencePoint& point);
    // In place of the point of the same kind and number of samples; among the others if there is none.
    void set(const ConvergencePoint& point);
    // Of the steps of a drag through other mixes the last one is marked.
    void mark(const ConvergenceMark& mark);

    const std::vector<ConvergencePoint>& points() const { return points_; }
    const std::vector<ConvergenceMark>& marks() const { return marks_; }
    std::vector<ConvergencePoint> points(ConvergencePoint::Kind kind) const;

private:
    std::vector<ConvergencePoint> points_;
    std::vector<ConvergenceMark> marks_;
};

// The slope of one kind's error over its last 64-fold growth in samples, from the last other mix on, which is what matters for how it goes on. Points of one run share
// samples: see fit_running().
PowerFit fit(const ConvergenceRecord& record, ConvergencePoint::Kind kind, ErrorMetric metric, ProgressAxis axis);

// How long until the error is `target`, if it goes on as it fell.
struct TimeLeft {
    enum class State {
        reached,
        known,    // seconds, low and high are; high may be infinite
        too_few,  // points to tell a slope from
        no_trend, // the error does not fall for sure
        too_far,  // more than 1000 times as long as the run so far: nobody knows whether it goes on like this
    };
    State state = State::too_few;
    double seconds = 0, low = 0, high = 0;
};
// From the last point on, not from the fitted line, along its slope. Low and high take the ends of both intervals, the slope's and the last
// point's, so that they hold more often than 95 %.
TimeLeft time_left(const ConvergenceRecord& record, ConvergencePoint::Kind kind, ErrorMetric metric, double target);

// ---- fair measuring of several settings side by side

// Whose turn it is: the one that has rendered for the shortest time among those not done, so that whatever slows the machine down slows all
// alike. `seconds` so far; -1 for those that are done. -1 if all are.
int next_turn(const std::vector<double>& seconds);

// When to look at the error: first when something is there, then whenever time has doubled.
class DoublingTimes {
public:
    // True if now, at this much time, it is due; the next is then due at twice that.
    bool due(double seconds);

private:
    double next_ = 0;
};

} // namespace blush
