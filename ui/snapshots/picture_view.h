// What the viewport shows of a frame: the beauty, or a picture computed from its other planes. Only a view: it does not restart
// the render and is not saved.
#pragma once

#include "render/frame.h"

#include <span>
#include <string>
#include <vector>

namespace blush {

struct PictureView {
    enum class Show {
        beauty,
        bounces,     // sum of the bounce planes, each with its gain
        dropped,     // number of dropped samples
        path_length, // mean number of vertices
        survival,    // mean survival probability of Russian roulette
        illuminance, // lux, for diffuse surfaces: input of the false colours in lux
        albedo,      // first-hit data, as the next four
        normal,
        depth,
        object_id,
        material_id,
        error,   // standard error of each pixel, relative to its value
        samples, // per pixel
        group,   // a light group, in the current light mix
    };
    Show show = Show::beauty;
    std::vector<float> gains = {}; // per bounce
    int group = 0;                 // index in the frame's light groups
    bool operator==(const PictureView&) const = default;
};

// Heat map colour for 0 .. 1: black, blue, red, yellow, white; luminance increases, so that it is readable without colour.
Vec3 heat(float t);

// True if the frame has the required planes and the view is not just the beauty.
bool is_special(const Frame& frame, const PictureView& view);
// True if its colours represent numbers other than light.
bool is_map(const PictureView& view);
// True if its colours are display values: no exposure, no view transform.
bool is_data(const PictureView& view);
// width * height * 4 scene-linear values of a special view. Heat maps go from black over blue, red and yellow to white.
std::vector<float> pixels_of(const Frame& frame, const PictureView& view);
// `rgba` with the coverage by objects (coverage.h) as alpha.
std::vector<float> with_coverage(const Frame& frame, std::vector<float> rgba);
// True if the light mix changes the gain of any group; the bounce planes do not include the mix.
bool is_mixed(std::span<const Vec3> gains);
// One-line caption of a special view; it also says that this is not the whole picture.
std::string caption_of(const Frame& frame, const PictureView& view);

} // namespace blush
