// How large the picture is on the screen and which part of it is seen: the maths, without drawing.
#pragma once

#include "ui/gizmo.h"
#include "ui/layout.h"

namespace blush {

struct PictureZoom {
    double scale = 0;        // pixels of the screen for one of the picture; 0: as large as fits
    double u = 0.5, v = 0.5; // of the picture, in the middle of the window's region
    bool operator==(const PictureZoom&) const = default;
};

constexpr double least_zoom = 1.0 / 16, most_zoom = 128;

// Where a picture of width x height pixels lies in a region of the window, on whole pixels.
ImageRect placed_picture(const PictureZoom& zoom, const Region& region, int width, int height);
// `factor` times as large about a place of the screen, which keeps its place in the picture. Smaller than what fits becomes what fits.
PictureZoom zoomed(const PictureZoom& zoom, const Region& region, int width, int height, ScreenPoint about, double factor);
// The picture dragged by so many pixels of the screen; its middle stays within the picture. What fits stays.
PictureZoom shifted(const PictureZoom& zoom, const Region& region, int width, int height, double dx, double dy);
// From what fits to one pixel of the screen for each of the picture, and back.
PictureZoom toggled(const PictureZoom& zoom);

} // namespace blush
