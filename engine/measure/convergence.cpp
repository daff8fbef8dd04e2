#include "measure/convergence.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

constexpr double growth = 1.1; // of samples between two points

template <class X> PowerFit fit(const std::vector<ConvergencePoint>& points, bool denoised, X x_of) {
    std::vector<double> x, y;
    for (const ConvergencePoint& p : points) {
        if (p.denoised != denoised || !(p.rmse > 0) || !(x_of(p) > 0)) continue;
        x.push_back(x_of(p));
        y.push_back(p.rmse);
    }
    return fit_power(x, y);
}

} // namespace

bool ConvergenceRecord::add(const ConvergencePoint& point) {
    const auto last =
        std::find_if(points_.rbegin(), points_.rend(), [&](const ConvergencePoint& p) { return p.denoised == point.denoised; });
    if (last != points_.rend() && double(point.spp) < growth * double(last->spp)) return false;
    points_.push_back(point);
    return true;
}

void ConvergenceRecord::clear() {
    points_.clear();
    marks_.clear();
}

PowerFit ConvergenceRecord::fit_seconds(bool denoised) const {
    return fit(points_, denoised, [](const ConvergencePoint& p) { return p.seconds; });
}
PowerFit ConvergenceRecord::fit_spp(bool denoised) const {
    return fit(points_, denoised, [](const ConvergencePoint& p) { return double(p.spp); });
}

double seconds_left(const ConvergenceRecord& record, double target) {
    const auto& points = record.points();
    const auto last = std::find_if(points.rbegin(), points.rend(), [](const ConvergencePoint& p) { return !p.denoised; });
    if (last == points.rend() || !(target > 0)) return -1;
    if (last->relmse <= target) return 0;
    const PowerFit f = record.fit_seconds();
    if (!f.slope.known || f.slope.value >= 0 || !(last->seconds > 0)) return -1;
    // From the last point on, not from the line: relmse falls with twice the slope of RMSE.
    return last->seconds * (std::pow(target / last->relmse, 0.5 / f.slope.value) - 1);
}

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == text.npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string to_csv(const std::vector<ConvergenceRecord>& records) {
    std::string csv = "name,seconds,spp,relmse,low,high,rmse,denoised\n";
    for (const ConvergenceRecord& r : records)
        for (const ConvergencePoint& p : r.points())
            csv += fmt::format("{},{:.6g},{},{:.6g},{:.6g},{:.6g},{:.6g},{}\n", csv_field(r.name), p.seconds, p.spp, p.relmse, p.low,
                               p.high, p.rmse, int(p.denoised));
    return csv;
}

int next_turn(const std::vector<double>& seconds) {
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
