// Convergence records: error over render time or samples, slopes and time to a target error.
#pragma once

#include "measure/statistics/intervals.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

enum class ErrorMetric { rmse, relmse };
enum class ProgressAxis { seconds, spp };

// The error of an image at one point of a render.
struct ConvergencePoint {
    enum class Kind {
        estimated, // of the raw image, from its A/B buffers
        measured,  // of the raw image, against a reference
        denoised,  // of the denoised image, against a reference or, less accurately, a later raw image
    };
    Kind kind = Kind::estimated;
    double seconds = 0; // render time without measuring
    int64_t spp = 0;
    Interval rmse, relmse; // not `known`: value without an interval

    double at(ProgressAxis axis) const { return axis == ProgressAxis::seconds ? seconds : double(spp); }
    const Interval& error(ErrorMetric metric) const { return metric == ErrorMetric::rmse ? rmse : relmse; }
};
std::string_view to_string(ConvergencePoint::Kind kind); // "estimated", "measured", "denoised"

// A mark in the plot: an edit or a change of settings.
struct ConvergenceMark {
    double seconds = 0;
    int64_t spp = 0;
    std::string label;
    bool other_mix = false; // earlier points use another light mix of the same samples: excluded from slopes

    double at(ProgressAxis axis) const { return axis == ProgressAxis::seconds ? seconds : double(spp); }
};

// The curves of one run. A point is kept if the sample count has grown by 10 % since the last one of its kind: evenly spaced in a
// log-log plot, about two hundred points for any run length.
class ConvergenceRecord {
public:
    std::string name;

    // True if add() would keep a point of this kind.
    bool is_due(ConvergencePoint::Kind kind, int64_t spp) const;
    // False if the point was skipped.
    bool add(const ConvergencePoint& point);
    // Replaces the point of the same kind and sample count, or inserts it.
    void set(const ConvergencePoint& point);
    // Consecutive marks of light mix changes (a drag) are merged to the last one.
    void mark(const ConvergenceMark& mark);

    const std::vector<ConvergencePoint>& points() const { return points_; }
    const std::vector<ConvergenceMark>& marks() const { return marks_; }
    std::vector<ConvergencePoint> points(ConvergencePoint::Kind kind) const;

private:
    std::vector<ConvergencePoint> points_;
    std::vector<ConvergenceMark> marks_;
};

// Slope of the error over the last 64-fold growth in samples since the last light mix change, for extrapolation. Points of a run
// share samples: see fit_running().
PowerFit fit(const ConvergenceRecord& record, ConvergencePoint::Kind kind, ErrorMetric metric, ProgressAxis axis);

// Extrapolated time until the error is `target`.
struct TimeLeft {
    enum class State {
        reached,
        known,    // seconds, low and high are valid; high may be infinite
        too_few,  // too few points for a slope
        no_trend, // no significant downward trend
        too_far,  // more than 1000 times the run so far: the extrapolation is not reliable
    };
    State state = State::too_few;
    double seconds = 0, low = 0, high = 0;
};
// Extrapolates from the last point along the fitted slope. Low and high combine the interval ends of the slope and of the last
// point, so that the coverage exceeds 95 %.
TimeLeft time_left(const ConvergenceRecord& record, ConvergencePoint::Kind kind, ErrorMetric metric, double target);

// ---- fair comparison of several settings, rendered alternately

// Index of the next variant to render: the one with the shortest time so far, so that machine load affects all equally. `seconds`:
// time so far, -1 for finished variants. Returns -1 if all are finished.
int next_variant(const std::vector<double>& seconds);

// Schedule of error measurements: at the first samples, then whenever the time has doubled.
class DoublingTimes {
public:
    // True if a measurement is due; the next one is then due at twice the time.
    bool due(double seconds);

private:
    double next_ = 0;
};

} // namespace blush
