// Zoom and pan of the image in the viewport: only the maths, no drawing.
#pragma once

#include "ui/transform/gizmo.h"
#include "ui/window/layout.h"

namespace blush {

struct ImageZoom {
    double scale = 0;        // screen pixels per image pixel; 0: fit
    double u = 0.5, v = 0.5; // the point of the image in the centre of the region
    bool operator==(const ImageZoom&) const = default;
};

constexpr double min_zoom = 1.0 / 16, max_zoom = 128;

// The rectangle of an image of width x height pixels in a region of the window, in whole pixels.
ImageRect image_rect(const ImageZoom& zoom, const Region& region, int width, int height);
// Zooms by `factor` about a screen position, which keeps its place in the image. If the result is smaller than fit, returns
// fit.
ImageZoom zoomed(const ImageZoom& zoom, const Region& region, int width, int height, ScreenPoint about, double factor);
// Pans by screen pixels; the centre of the region stays within the image. No effect if the zoom is fit.
ImageZoom shifted(const ImageZoom& zoom, const Region& region, int width, int height, double dx, double dy);
// Toggles between fit and 1:1.
ImageZoom toggled(const ImageZoom& zoom);

} // namespace blush
