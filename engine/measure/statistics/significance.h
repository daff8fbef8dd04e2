// Significance of differences, common to all bias tests.
#pragma once

namespace blush {

// Converts Student's t with `degrees` degrees of freedom to the normal deviate of equal probability (Wallace 1959), since the
// standard error is itself an estimate. 0 for no degrees.
double normal_deviate(double t, double degrees);

// Threshold of |deviate| for a family-wise level alpha over `tests` independent tests (Sidak 1967).
double significant_deviate(int tests, double alpha);

} // namespace blush
