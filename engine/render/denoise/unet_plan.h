// Where the planes of a network lie in memory for one size of image: those that are never needed at once share it.
#pragma once

#include "render/denoise/unet_layers.h"

#include <array>
#include <cstddef>

namespace blush::denoise {

// What the network multiplies. Sums are float32 either way.
enum class Element : unsigned char { float32, bfloat16 };
constexpr size_t bytes_of(Element element) { return element == Element::float32 ? 4 : 2; }

// In bfloat16 the picture comes in two parts that together hold 16 bits: the curve that it is coded with turns the last of 8 bits into up
// to 1 % of radiance. The input has so many channels more then, the second parts of its first ones.
inline constexpr int split_channels = 3;
constexpr int extra_inputs(Element element) { return element == Element::float32 ? 0 : split_channels; }

// Rows of one layer's output that a worker computes at a time: few enough to stay in its caches with what they are made of, and
// the same whatever the number of workers.
inline constexpr int band_rows = 8;

// Pixels with interleaved channels, rows without gaps. In memory a row of zeros lies before the first row and behind the last:
// the convolution's padding.
struct UnetPlane {
    int width = 0, height = 0, channels = 0;
    Element element = Element::float32;
    size_t offset = 0; // of the row of zeros, in bytes

    size_t row_elements() const { return size_t(width) * channels; }
    size_t row_bytes() const { return row_elements() * bytes_of(element); }
};

struct UnetPlan {
    std::array<UnetPlane, unet_plane_count> planes = {}; // the last one is handed out row by row and has no place
    size_t plane_bytes = 0;                              // of all planes
    size_t band_bytes = 0;                               // what a worker needs for its own: input and output of a band

    size_t bytes(unsigned workers) const { return plane_bytes + workers * 2 * band_bytes; }
};

// Sides must be multiples of unet_side_multiple. The last layer reads and makes float32 whatever the `element` of the others: few
// operations, and nothing after it averages its errors away.
UnetPlan plan_unet(const UnetChannels& channels, int width, int height, Element element);

} // namespace blush::denoise
