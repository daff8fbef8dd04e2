// What the viewport shows of a frame: the beauty, or an image computed from its other planes (image_pixels.h). Only a view: it
// does not restart the render and is not saved.
#pragma once

#include <array>
#include <vector>

namespace blush {

struct ImageView {
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
        error,          // standard error of each pixel, relative to its value
        samples,        // per pixel
        group,          // a light group, in the current light mix
        strategy,       // light that one strategy has found
        indirect_share, // share of indirect light in the luminance
        bleed,          // hue difference between direct light alone and all light
        two_piles,      // direct, indirect and all light, each in its part of the image
    };
    Show show = Show::beauty;
    std::vector<float> gains = {}; // per bounce
    int group = 0;                 // index in the frame's light groups
    int strategy = 0;              // FoundBy
    std::array<float, 2> wipes{};  // of the two piles: where the parts of direct and indirect light end, 0 .. 1 of the width
    bool operator==(const ImageView&) const = default;
};

// True if its colours represent numbers other than light.
bool is_map(const ImageView& view);
// True if its colours are display values: no exposure, no view transform.
bool is_data(const ImageView& view);

} // namespace blush
