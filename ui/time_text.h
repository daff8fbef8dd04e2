// Seconds as people read them.
#pragma once

#include <string>

namespace blush {

// "12.3 s", "4:05 min", "2:00:07 h": of what has passed, to the tenth, rounded down from a minute on. "-" for what is no number, or
// longer than 30,000 years.
std::string elapsed_text(double seconds);

// "0.8 s", "12 s", "4 min", "1.5 h", "3 days": of what is guessed, to about two digits.
std::string guessed_time_text(double seconds);

} // namespace blush
