// Formats durations.
#pragma once

#include <string>

namespace blush {

// "12.3 s", "4:05 min", "2:00:07 h": elapsed time, in tenths of a second, rounded down to seconds from a minute on. "-" for NaN
// or more than 30,000 years.
std::string elapsed_text(double seconds);

// "0.8 s", "12 s", "4 min", "1.5 h", "3 days": estimated time, about two digits.
std::string guessed_time_text(double seconds);

} // namespace blush
