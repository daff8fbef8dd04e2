#include "ui/views/convergence_view.h"

#include "ui/window/time_text.h"

#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

// Fixed digits with a true minus sign; no sign if the value rounds to zero.
std::string signed_text(double value) { return fmt::format("{}{:.2f}", value <= -0.005 ? "−" : "", std::abs(value)); }

const char* kind_text(ConvergencePoint::Kind kind) {
    switch (kind) {
    case ConvergencePoint::Kind::estimated: return "raw image, estimated";
    case ConvergencePoint::Kind::measured: return "raw image, against the reference";
    case ConvergencePoint::Kind::denoised: return "denoised image";
    }
    return "";
}

} // namespace

std::string error_text(const Interval& error) {
    if (!(error.value > 0)) return "not known yet";
    if (!error.known) return fmt::format("{:.3g}", error.value);
    return fmt::format("{:.3g} ({:.3g} to {:.3g})", error.value, error.low, error.high);
}

std::string slope_text(const Interval& slope) {
    if (!slope.known) return "slope not known yet";
    return fmt::format("slope {} ({} to {})", signed_text(slope.value), signed_text(slope.low), signed_text(slope.high));
}

std::string time_left_text(const TimeLeft& left) {
    switch (left.state) {
    case TimeLeft::State::reached: return "target reached";
    case TimeLeft::State::too_few: return "time to the target not known yet";
    case TimeLeft::State::no_trend: return "time to the target not known: no significant downward trend yet";
    case TimeLeft::State::too_far: return "the target is too far away to predict the time";
    case TimeLeft::State::known: break;
    }
    const std::string low = guessed_time_text(left.low), high = guessed_time_text(left.high);
    return low == high ? fmt::format("target in {}", guessed_time_text(left.seconds))
                       : fmt::format("target in {} ({} to {})", guessed_time_text(left.seconds), low, high);
}

std::string share_text(double share) {
    const double per_cent = 100 * share;
    return fmt::format("{:.2f} %", std::ceil(per_cent * 100 - 1e-9) / 100);
}

std::string readout_text(const std::string& run, const ConvergencePoint& point, ErrorMetric metric) {
    return fmt::format("{}\n{}\n{}   {} spp\n{} {}", run, kind_text(point.kind), elapsed_text(point.seconds), point.spp,
                       metric == ErrorMetric::rmse ? "RMSE" : "relMSE", error_text(point.error(metric)));
}

} // namespace blush
