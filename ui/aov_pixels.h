// Planes of the film as colours: albedo, normals, depth, ids, error, samples (AOVs).
#pragma once

#include "ui/picture_view.h"

#include <optional>
#include <string>

namespace blush {

// width * height * 4 values of a plane that is data (is_data()), which the frame must have: linear colours that the display encodes by the sRGB
// curve and nothing else, alpha 0. Albedo as it is; normals n / 2 + 1 / 2; depth from black, the nearest, to white, the furthest, with nothing
// hit in blue; ids in colours of their own that stay the same from frame to frame; error and samples as a heat map.
std::vector<float> aov_pixels(const Frame& frame, PictureView::Show show);
// A group of lights, as the mix has it.
Vec3 group_pixel(const Frame& frame, size_t group, size_t pixel);
// The colour of a number that is a name: 0 is black.
Vec3 id_color(uint32_t id);
// The standard error of a pixel's luminance over sqrt(luminance^2 + 0.01), as relMSE weighs it.
float relative_error(const Frame& frame, size_t pixel);
// In words.
std::string aov_caption(const Frame& frame, PictureView::Show show);

// What a map's colours mean: numbers at its bottom, middle and top, and the colour of 0 .. 1 between them as the display shows it.
struct MapScale {
    std::string title, low, middle, high;
    Vec3 (*color)(float t) = nullptr; // display-encoded
};
// Of depth, error and samples; none of others.
std::optional<MapScale> map_scale(const Frame& frame, PictureView::Show show);

} // namespace blush
