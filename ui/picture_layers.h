// The layers of a picture that another program made: which channels make a layer, and how a layer is shown.
#pragma once

#include "io/image_io.h"
#include "render/frame.h"

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace blush {

// Some channels of an image that are looked at together: red, green, blue and perhaps alpha; three coordinates; or one number.
struct PictureLayer {
    enum class Kind { color, vector, number, id };
    std::string name;     // "Beauty", "diffuse", "N", "depth.Z", with the part's name before it where the file has several
    std::string channels; // as the file calls them
    Kind kind = Kind::color;
    size_t part = 0;                         // of the file
    std::array<int, 4> channel{-1, -1, -1, -1}; // of the part; -1: none
};

struct PictureLayers {
    std::filesystem::path file;
    std::vector<LayeredImage> parts;
    std::vector<PictureLayer> layers; // at least one
    size_t chosen = 0;
};

// The layers of a file: "NAME.R", "NAME.G", "NAME.B" (and A) are one, as are X, Y, Z and names in small letters; R, G, B without a name are the
// beauty, which comes first; every other channel is a layer of its own. None without channels.
std::vector<PictureLayer> layers_of(const std::vector<LayeredImage>& parts);
// All of a file, the beauty chosen. Errors as in read_parts.
Result<std::shared_ptr<PictureLayers>> open_picture_layers(const std::filesystem::path& file);
// Is it a panorama, as environments are kept: one image, twice as wide as high, of colours alone?
bool is_panorama(const PictureLayers& picture);
// The chosen layer as a picture. Colours are as they are; vectors v / 2 + 1 / 2; numbers run from black, the least, to white, the largest; ids
// have a colour each. What is no number is black.
FramePtr frame_of(const PictureLayers& picture);
// "from 0.5 to 12.25": the range of a layer of numbers; empty of others.
std::string range_text(const PictureLayers& picture);

} // namespace blush
