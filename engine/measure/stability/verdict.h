// Comparison of a case: expected and measured value, with tolerance.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace blush::stability {

// A known value and a measured one.
struct Finding {
    double expected = 0, measured = 0;
    double sigma = 0;    // standard error of `measured`; 0 without randomness
    double rounding = 0; // tolerance for rounding errors and conditioning
    std::string where;   // name of the finding within the case
};
using Findings = std::vector<Finding>;

// Relative rounding error of some dozen single-precision operations, allowed for every finding.
constexpr double float_rounding = 64 * 0x1p-24;

// Probability of a false failure of the battery. Seeds are fixed, so it applied once, when a case was written.
constexpr double family_wise_level = 0.01;

// Level of each of `count` independent tests that together have `overall` (Sidak 1967).
double sidak(double overall, int64_t count);

// rounding + k sigma + single precision rounding.
double tolerance(const Finding& finding, double k);
// |measured - expected| <= tolerance. False for non-finite values.
bool holds(const Finding& finding, double k);
// The finding with the largest deviation relative to its tolerance; for no findings an empty one that fails.
const Finding& worst_of(const Findings& findings, double k);

} // namespace blush::stability
