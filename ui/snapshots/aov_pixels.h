// Converts AOVs to colours: albedo, normal, depth, ids, error, samples, share of indirect light, bleed.
#pragma once

#include "render/frame.h"
#include "ui/snapshots/image_view.h"

#include <optional>
#include <string>

namespace blush {

// Colours of a data AOV (is_data()) that the frame must have: width * height * 4 linear values, alpha 0. The display applies
// only the sRGB curve. Albedo is unchanged; normals are n / 2 + 1 / 2; depth is black at the nearest and white at the furthest
// hit, blue where nothing is hit; ids have fixed colours that do not change between frames; error and samples are heat maps.
std::vector<float> aov_pixels(const Frame& frame, ImageView::Show show);
// The plane of a light group, in the current light mix.
Vec3 group_pixel(const Frame& frame, size_t group, size_t pixel);
// The colour of an id: 0 is black.
Vec3 id_color(uint32_t id);
// Standard error of a pixel's luminance, divided by sqrt(luminance^2 + 0.01), as in relMSE.
float relative_error(const Frame& frame, size_t pixel);
// One-line description.
std::string aov_caption(const Frame& frame, ImageView::Show show);

// Legend of a map: labels for its bottom, middle and top, and the display colour for values 0 .. 1.
struct MapScale {
    std::string title, low, middle, high;
    Vec3 (*color)(float t) = nullptr; // display-encoded
};
// For depth and heat maps; nullopt for other AOVs.
std::optional<MapScale> map_scale(const Frame& frame, ImageView::Show show);

} // namespace blush
