// Writes a chart as SVG, for reports and for export from the window.
#pragma once

#include "measure/plot/plot.h"

#include <string>

namespace blush {

// A self-contained <svg> element: no scripts or external resources.
std::string to_svg(const Plot& plot);

// Escapes text and quotes for HTML and SVG; control characters, which XML does not allow, become spaces.
std::string escaped_markup(const std::string& text);

} // namespace blush
