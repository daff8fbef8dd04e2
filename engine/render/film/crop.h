// Crops a frame to a rectangle.
#pragma once

#include "render/frame.h"
#include "render/session/denoised_image.h"
#include "scene/image_region.h"

#include <vector>

namespace blush {

// All planes of the frame within `rect`, which must lie inside it. Statistics of the whole image are dropped: the error, and the
// shares of its light groups.
Frame cropped(const Frame& frame, const PixelRect& rect);
// Same size as the frame; null stays null. The light groups are dropped.
DenoisedPtr cropped(const DenoisedPtr& image, const PixelRect& rect);
// `values_per_pixel` numbers for each pixel of an image of the given `width`; empty stays empty.
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
