// Statistics of a rectangle of the image, in several units.
#pragma once

#include "measure/metrics/scopes.h"
#include "ui/jobs/async_query.h"
#include "ui/views/shown_image.h"

#include <array>

namespace blush {

struct RegionStatistics {
    int x = 0, y = 0, width = 0, height = 0;  // pixels of the frame
    std::array<ValueStatistics, 3> linear;    // scene-linear red, green, blue
    ValueStatistics nits;                     // luminance
    ValueStatistics ev;                       // stops from middle grey after exposure and white balance; without black pixels
    ValueStatistics ev100;                    // EV at ISO 100, log2(luminance / 0.125), of a meter with K = 12.5; without black pixels
    std::array<ValueStatistics, 3> displayed; // display-encoded, 0 .. 1; empty if the view transform fails
};

// Of the view's measured region: all pixels that it touches, at least one.
RegionStatistics region_statistics(const ShownImage& image);

using RegionView = AsyncQuery<ShownImage, RegionStatistics>;

} // namespace blush
