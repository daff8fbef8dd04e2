// Layers of an EXR from another program: which channels form a layer, and how it is displayed.
#pragma once

#include "io/image/image_io.h"
#include "render/frame.h"

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace blush {

// Channels that are displayed together: red, green, blue and optionally alpha; three coordinates; or a single number.
struct ImageLayer {
    enum class Kind { color, vector, number, id };
    std::string name;     // "Beauty", "diffuse", "N", "depth.Z", with the part's name as prefix if the file has several parts
    std::string channels; // names in the file
    Kind kind = Kind::color;
    size_t part = 0;                            // of the file
    std::array<int, 4> channel{-1, -1, -1, -1}; // index in the part; -1: none
};

struct ImageLayers {
    std::filesystem::path file;
    std::vector<LayeredImage> parts;
    std::vector<ImageLayer> layers; // at least one
    size_t chosen = 0;
};

// The layers of a file: "NAME.R", "NAME.G", "NAME.B" (and A) form one layer, also with X, Y, Z or lower-case letters; R, G, B
// without a name are the beauty, which comes first; every other channel is a layer of its own. Empty without channels.
std::vector<ImageLayer> layers_of(const std::vector<LayeredImage>& parts);
// Reads all layers of a file; the beauty is the chosen one. Errors as in read_parts.
Result<std::shared_ptr<ImageLayers>> open_image_layers(const std::filesystem::path& file);
// True if it is probably an environment panorama: one image, twice as wide as high, with colours only.
bool is_panorama(const ImageLayers& image);
// The chosen layer as an image. Colours are unchanged; vectors are v / 2 + 1 / 2; numbers go from black (minimum) to white
// (maximum); each id has its own colour. Non-finite values are black.
FramePtr frame_of(const ImageLayers& image);
// "from 0.5 to 12.25": the range of a layer of numbers; empty for other layers.
std::string range_text(const ImageLayers& image);

} // namespace blush
