#include "tests/support/error_coverage.h"

#include <cmath>

namespace blush::test {

TrueError true_error(const Frame& frame, const Truth& truth) {
    double squares = 0, relative = 0;
    const auto channel = [&](double value, double mean, double variance) {
        const double square = (value - mean) * (value - mean) - variance;
        squares += square;
        relative += square / (mean * mean + 0.01);
    };
    for (size_t i = 0; i < truth.mean.size(); ++i) {
        const float* rgba = &frame.rgba[4 * i];
        channel(double(rgba[0]), truth.mean[i].x, truth.variance[i].x);
        channel(double(rgba[1]), truth.mean[i].y, truth.variance[i].y);
        channel(double(rgba[2]), truth.mean[i].z, truth.variance[i].z);
    }
    const double values = 3 * double(truth.mean.size());
    return {relative / values, std::sqrt(squares / values)};
}

void Coverage::add(const ErrorEstimate& e, const TrueError& truth) {
    ++runs;
    rmse_known += e.rmse_known;
    rmse_covered += e.rmse_known && e.rmse_low <= truth.rmse && truth.rmse <= e.rmse_high;
    if (!e.known) return;
    ++known;
    covered += e.low <= truth.relmse && truth.relmse <= e.high;
    log_ratio += std::log(e.relmse / truth.relmse);
    log_width += std::log(e.high / e.low);
}

void Coverage::merge(const Coverage& o) {
    runs += o.runs;
    known += o.known;
    covered += o.covered;
    rmse_known += o.rmse_known;
    rmse_covered += o.rmse_covered;
    log_ratio += o.log_ratio;
    log_width += o.log_width;
}

} // namespace blush::test
