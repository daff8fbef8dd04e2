#include "measure/stability/verdict.h"

#include <cmath>
#include <limits>

namespace blush::stability {
namespace {

// Deviation in units of the tolerance.
double strain(const Finding& f, double k) {
    if (!std::isfinite(f.measured) || !std::isfinite(f.sigma)) return std::numeric_limits<double>::infinity();
    const double deviation = std::abs(f.measured - f.expected);
    if (deviation == 0) return 0;
    return deviation / tolerance(f, k); // infinite for zero tolerance
}

} // namespace

double sidak(double overall, int64_t count) { return -std::expm1(std::log1p(-overall) / double(count)); }

double tolerance(const Finding& f, double k) { return f.rounding + k * f.sigma + float_rounding * std::abs(f.expected); }

bool holds(const Finding& f, double k) { return strain(f, k) <= 1; }

const Finding& worst_of(const Findings& findings, double k) {
    static const Finding none{.measured = std::numeric_limits<double>::quiet_NaN(), .where = "nothing was measured"};
    const Finding* worst = findings.empty() ? &none : &findings[0];
    for (const Finding& f : findings)
        if (strain(f, k) > strain(*worst, k)) worst = &f;
    return *worst;
}

} // namespace blush::stability
