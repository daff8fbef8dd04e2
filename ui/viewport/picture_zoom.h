// Zoom and pan of the picture in the viewport: only the maths, no drawing.
#pragma once

#include "ui/transform/gizmo.h"
#include "ui/window/layout.h"

namespace blush {

struct PictureZoom {
    double scale = 0;        // screen pixels per picture pixel; 0: fit
    double u = 0.5, v = 0.5; // the point of the picture in the centre of the region
    bool operator==(const PictureZoom&) const = default;
};

constexpr double min_zoom = 1.0 / 16, max_zoom = 128;

// The rectangle of a picture of width x height pixels in a region of the window, in whole pixels.
ImageRect picture_rect(const PictureZoom& zoom, const Region& region, int width, int height);
// Zooms by `factor` about a screen position, which keeps its place in the picture. If the result is smaller than fit, returns
// fit.
PictureZoom zoomed(const PictureZoom& zoom, const Region& region, int width, int height, ScreenPoint about, double factor);
// Pans by screen pixels; the centre of the region stays within the picture. No effect if the zoom is fit.
PictureZoom shifted(const PictureZoom& zoom, const Region& region, int width, int height, double dx, double dy);
// Toggles between fit and 1:1.
PictureZoom toggled(const PictureZoom& zoom);

} // namespace blush
