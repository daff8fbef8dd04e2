// A chart as SVG: for reports and for the window's export.
#pragma once

#include "measure/plot.h"

#include <string>

namespace blush {

// An <svg> element that stands alone: its own text sizes and colours, no script, no outside resource.
std::string to_svg(const Plot& plot);

// Text inside HTML or SVG, quotes too; control characters, which XML does not allow, become spaces.
std::string escaped_markup(const std::string& text);

} // namespace blush
