// Overlay drawing over the image: lines given in the world, labels, and a line of text at the top.
#pragma once

#include "ui/transform/gizmo.h"

#include <imgui.h>
#include <optional>
#include <string>
#include <utility>

namespace blush {

// The ends of a world-space segment on the screen, clipped at the near plane; nullopt if it is behind the viewer.
std::optional<std::pair<ScreenPoint, ScreenPoint>> projected_line(const Projection& projection, const ImageRect& image, Vec3d a, Vec3d b);

// Draws lines given in world coordinates, clipped at the near plane.
struct WorldPen {
    ImDrawList& draw;
    const Projection& projection;
    const ImageRect& image;
    ImU32 color;
    float weight = 1;  // of the lines, relative to the default width
    float edge = 2.2f; // width of the dark line below, relative to the line

    void line(Vec3d a, Vec3d b) const;
    // An ellipse with these semi-axes.
    void circle(const Vec3d& centre, const Vec3d& x, const Vec3d& y) const;
    // A cross perpendicular to the view direction.
    void cross(const Vec3d& centre, double half) const;
};

// A ring around the inspected pixel; (u, v) in the image.
void draw_read_pixel(ImDrawList& draw, const ImageRect& image, double u, double v);

// Widest part of a label or hint that a name may take: names can have any length.
float max_name_width();

// A line of text on a dark field, shortened in the middle if the field is wider than `room`. Returns the field's size. `at`: its upper
// left corner.
ImVec2 draw_label(ImDrawList& draw, const std::string& text, const ImVec2& at, float room, ImU32 color);
// The size that draw_label() gives it.
ImVec2 label_size(const std::string& text, float room);

// A hint for the current mouse action, at the upper edge.
void draw_hint(ImDrawList& draw, const std::string& text);

} // namespace blush
