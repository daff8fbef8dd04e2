// A rectangular region of an image in relative coordinates, independent of the resolution.
#pragma once

#include <algorithm>
#include <cmath>

namespace blush {

// (0, 0) top left, (1, 1) bottom right.
struct ImageRegion {
    float x = 0, y = 0, width = 1, height = 1;
    bool operator==(const ImageRegion&) const = default;
};

// Pixels x0 .. x1 - 1, y0 .. y1 - 1.
struct PixelRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    bool operator==(const PixelRect&) const = default;
};

// The region in pixels of a width x height image; edges are rounded to the nearest pixel edge, at least one pixel.
inline PixelRect pixels_of(const ImageRegion& r, int width, int height) {
    const auto edge = [](double at, int count, int least, int most) { return std::clamp(int(std::lround(at * count)), least, most); };
    PixelRect p;
    p.x0 = edge(r.x, width, 0, width - 1);
    p.y0 = edge(r.y, height, 0, height - 1);
    p.x1 = edge(double(r.x) + double(r.width), width, p.x0 + 1, width);
    p.y1 = edge(double(r.y) + double(r.height), height, p.y0 + 1, height);
    return p;
}

} // namespace blush
