// Which picture of a frame the viewport shows: the beauty, or one that is made of the frame's other planes. A way of looking: nothing is
// rendered for it, and nothing of it is saved.
#pragma once

#include "render/frame.h"

#include <span>
#include <string>
#include <vector>

namespace blush {

struct PictureView {
    enum class Show {
        beauty,
        bounces,     // the bounce planes, each times its gain
        dropped,     // where samples could not be used
        path_length, // mean number of vertices
        survival,    // mean probability that roulette gave
        illuminance, // lux, if surfaces are matte: what false colours of lux are made of
        albedo,      // of first hits, as are the next four
        normal,
        depth,
        object_id,
        material_id,
        error,       // standard error of each pixel's mean, of its value
        samples,     // of each pixel
        group,       // of lights, as the light mix has it
    };
    Show show = Show::beauty;
    std::vector<float> gains = {}; // of bounces
    int group = 0;                 // of the frame's groups of lights
    bool operator==(const PictureView&) const = default;
};

// A map's colour for 0 .. 1: black, blue, red, yellow, white; dark to bright, so that it reads without colours too.
Vec3 heat(float t);

// The frame has what the view needs and it is not simply the beauty.
bool is_special(const Frame& frame, const PictureView& view);
// Its colours stand for numbers that are no light.
bool is_map(const PictureView& view);
// Its colours are those of the screen: no exposure, no view transform.
bool is_data(const PictureView& view);
// width * height * 4 scene-linear values of a special view. Maps run from black over blue, red and yellow to white.
std::vector<float> pixels_of(const Frame& frame, const PictureView& view);
// `rgba`, a picture of the frame's, its alpha the coverage by objects (coverage.h).
std::vector<float> with_coverage(const Frame& frame, std::vector<float> rgba);
// Are lights brighter or darker than the planes of bounces know, which are not mixed?
bool is_mixed(std::span<const Vec3> gains);
// Says what a special view shows and that it is not the picture, in one line.
std::string caption_of(const Frame& frame, const PictureView& view);

} // namespace blush
