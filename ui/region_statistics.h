// What a rectangle of the picture holds, in all the units that are spoken of.
#pragma once

#include "measure/scopes.h"
#include "ui/background_answer.h"
#include "ui/shown_picture.h"

#include <array>

namespace blush {

struct RegionStatistics {
    int x = 0, y = 0, width = 0, height = 0; // pixels of the frame
    std::array<Spread, 3> linear;            // scene-linear red, green, blue
    Spread nits;                             // luminance
    Spread ev;                               // stops from middle grey as exposed and balanced; of pixels that are not black
    Spread ev100;                            // log2(luminance / 0.125): the exposure value at ISO 100 of a meter with K = 12.5
    std::array<Spread, 3> displayed;         // display-encoded, 0 .. 1; nothing if the view cannot be had
};

// Of the region that the picture's view measures: all pixels that it touches, one at least.
RegionStatistics region_statistics(const ShownPicture& picture);

using RegionView = BackgroundAnswer<ShownPicture, RegionStatistics>;

} // namespace blush
