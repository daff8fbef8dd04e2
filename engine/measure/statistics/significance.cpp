#include "measure/statistics/significance.h"

#include "measure/statistics/intervals.h"

#include <cmath>

namespace blush {

double normal_deviate(double t, double degrees) {
    if (!(degrees > 0)) return 0;
    return std::copysign((8 * degrees + 1) / (8 * degrees + 3) * std::sqrt(degrees * std::log1p(t * t / degrees)), t);
}

double significant_deviate(int tests, double alpha) { return normal_quantile_two_sided(-std::expm1(std::log1p(-alpha) / tests)); }

} // namespace blush
