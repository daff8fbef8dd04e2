// What is drawn over the picture: lines given in the world, and a line of text on top.
#pragma once

#include "ui/gizmo.h"

#include <imgui.h>
#include <string>

namespace blush {

// Draws lines given in the world, cut at the plane of the eye.
struct WorldPen {
    ImDrawList& draw;
    const Projection& projection;
    const ImageRect& image;
    ImU32 color;
    float weight = 1; // of the lines, relative to the usual width

    void line(Vec3d a, Vec3d b) const;
    // An ellipse with these half axes.
    void circle(const Vec3d& centre, const Vec3d& x, const Vec3d& y) const;
    // Two strokes across the line of sight.
    void cross(const Vec3d& centre, double half) const;
};

// A ring round the pixel whose values are read; (u, v) of the picture.
void draw_read_pixel(ImDrawList& draw, const ImageRect& image, double u, double v);

// What the mouse does now, at the upper edge of what is drawn into.
void draw_hint(ImDrawList& draw, const std::string& text);

} // namespace blush
