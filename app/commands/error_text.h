// The estimated error of an image in words, for summaries.
#pragma once

#include "render/frame.h"

#include <string>

namespace blush {

// "estimated relMSE 0.0123 (0.0118 to 0.0129), RMSE 0.02 (0.01 to 0.03)": those that are known, with their 95 % intervals and so many
// significant digits; or that none is known, and why.
std::string error_text(const ErrorEstimate& error, int digits);

} // namespace blush
