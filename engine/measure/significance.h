// Is a difference more than noise? What all tests of bias have in common.
#pragma once

namespace blush {

// Student's t with `degrees` degrees of freedom, as the normal deviate that is as unlikely (Wallace 1959): the standard error of a
// difference is itself uncertain. 0 for no degrees.
double normal_deviate(double t, double degrees);

// |deviate| beyond which one of `tests` tests is with probability alpha, all of them being of nothing but noise (Sidak 1967).
double significant_deviate(int tests, double alpha);

} // namespace blush
