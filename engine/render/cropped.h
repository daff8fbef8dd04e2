// A rectangle of a picture as a picture of its own.
#pragma once

#include "render/denoised_picture.h"
#include "render/frame.h"
#include "scene/picture_region.h"

#include <vector>

namespace blush {

// All planes of the frame within `rect`, which lies in it. What is known of the picture as a whole is not known of a part: its error, and the
// shares of its light groups.
Frame cropped(const Frame& frame, const PixelRect& rect);
// Of the same size as the frame; null stays null. It is no longer known by groups of lights.
DenoisedPtr cropped(const DenoisedPtr& picture, const PixelRect& rect);
// `values_per_pixel` numbers for each pixel of a picture of `width`; empty stays empty.
template <class T> std::vector<T> cropped(const std::vector<T>& plane, int width, const PixelRect& rect, size_t values_per_pixel = 1) {
    std::vector<T> part;
    if (plane.empty()) return part;
    const size_t row = size_t(rect.x1 - rect.x0) * values_per_pixel;
    part.reserve(row * size_t(rect.y1 - rect.y0));
    for (int y = rect.y0; y < rect.y1; ++y) {
        const auto first = plane.begin() + ptrdiff_t((size_t(y) * size_t(width) + size_t(rect.x0)) * values_per_pixel);
        part.insert(part.end(), first, first + ptrdiff_t(row));
    }
    return part;
}

} // namespace blush
