#include "measure/convergence/convergence.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

using Kind = ConvergencePoint::Kind;

constexpr double growth = 1.1;             // growth of samples between two points
constexpr int64_t fitted_growth = 64;      // range of samples for the slope
constexpr double max_extrapolation = 1000; // limit of extrapolation, relative to the run's length

} // namespace

std::string_view to_string(Kind kind) {
    switch (kind) {
    case Kind::estimated: return "estimated";
    case Kind::measured: return "measured";
    case Kind::denoised: return "denoised";
    }
    return "";
}

bool ConvergenceRecord::is_due(Kind kind, int64_t spp) const {
    const auto last = std::find_if(points_.rbegin(), points_.rend(), [&](const ConvergencePoint& p) { return p.kind == kind; });
    return last == points_.rend() || double(spp) >= growth * double(last->spp);
}

bool ConvergenceRecord::add(const ConvergencePoint& point) {
    if (!is_due(point.kind, point.spp)) return false;
    points_.push_back(point);
    return true;
}

void ConvergenceRecord::set(const ConvergencePoint& point) {
    const auto at = std::ranges::find_if(points_, [&](const ConvergencePoint& p) { return p.kind == point.kind && p.spp >= point.spp; });
    if (at != points_.end() && at->spp == point.spp)
        *at = point;
    else
        points_.insert(at, point);
}

void ConvergenceRecord::mark(const ConvergenceMark& mark) {
    const bool goes_on = mark.other_mix && !marks_.empty() && marks_.back().other_mix && marks_.back().label == mark.label;
    if (goes_on)
        marks_.back() = mark;
    else
        marks_.push_back(mark);
}

std::vector<ConvergencePoint> ConvergenceRecord::points(Kind kind) const {
    std::vector<ConvergencePoint> some;
    std::ranges::copy_if(points_, std::back_inserter(some), [&](const ConvergencePoint& p) { return p.kind == kind; });
    return some;
}

PowerFit fit(const ConvergenceRecord& record, Kind kind, ErrorMetric metric, ProgressAxis axis) {
    std::vector<double> x, y, samples;
    const std::vector<ConvergencePoint> points = record.points(kind);
    int64_t mixed_at = 0;
    for (const ConvergenceMark& m : record.marks())
        if (m.other_mix) mixed_at = std::max(mixed_at, m.spp);
    for (const ConvergencePoint& p : points) {
        if (p.spp < mixed_at || p.spp < points.back().spp / fitted_growth || !(p.error(metric).value > 0) || !(p.at(axis) > 0)) continue;
        x.push_back(p.at(axis));
        y.push_back(p.error(metric).value);
        samples.push_back(double(p.spp));
    }
    return fit_running(x, y, samples);
}

TimeLeft time_left(const ConvergenceRecord& record, Kind kind, ErrorMetric metric, double target) {
    using State = TimeLeft::State;
    const std::vector<ConvergencePoint> points = record.points(kind);
    if (points.empty() || !(target > 0)) return {};
    const ConvergencePoint& last = points.back();
    const Interval& error = last.error(metric);
    if (error.value <= target) return {State::reached};
    const Interval slope = fit(record, kind, metric, ProgressAxis::seconds).slope;
    if (!slope.known || !(last.seconds > 0)) return {State::too_few};
    if (slope.high >= 0) return {State::no_trend};
    const auto left = [&](double from, double p) { return last.seconds * std::max(0.0, std::pow(target / from, 1 / p) - 1); };
    const double low = error.known ? error.low : error.value, high = error.known ? error.high : error.value;
    const TimeLeft t{State::known, left(error.value, slope.value), left(low, slope.low), left(high, slope.high)};
    return t.seconds <= max_extrapolation * last.seconds ? t : TimeLeft{State::too_far};
}

int next_variant(const std::vector<double>& seconds) {
    int next = -1;
    for (size_t i = 0; i < seconds.size(); ++i)
        if (seconds[i] >= 0 && (next < 0 || seconds[i] < seconds[size_t(next)])) next = int(i);
    return next;
}

bool DoublingTimes::due(double seconds) {
    if (seconds < next_) return false;
    next_ = 2 * seconds;
    return true;
}

} // namespace blush
