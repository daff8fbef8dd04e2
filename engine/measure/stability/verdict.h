// What a case compares, and how far apart the two may be.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace blush::stability {

// One number that is known against one that was measured.
struct Finding {
    double expected = 0, measured = 0;
    double sigma = 0;    // standard error of `measured`, from its own variance; 0 where nothing is random
    double rounding = 0; // how far arithmetic, or the conditioning of the question, may take `measured` from `expected`
    std::string where;   // which of a case's findings it is
};
using Findings = std::vector<Finding>;

// What a chain of some dozen single-precision operations may be off, relatively: allowed to every finding.
constexpr double float_rounding = 64 * 0x1p-24;

// Chance that the battery fails though nothing is wrong. Seeds are fixed, so it was taken once, when a case was written.
constexpr double family_wise_level = 0.01;

// Level of each of `count` independent tests that together have `overall` (Sidak 1967).
double sidak(double overall, int64_t count);

// rounding + k sigma + what single precision rounds.
double tolerance(const Finding& finding, double k);
// |measured - expected| <= tolerance. Nothing that is not finite holds.
bool holds(const Finding& finding, double k);
// The finding that comes closest to its tolerance or exceeds it the furthest; of none an empty one that does not hold.
const Finding& worst_of(const Findings& findings, double k);

} // namespace blush::stability
