// Memory layout of a network's planes for one image size: planes with disjoint lifetimes share memory.
#pragma once

#include "render/denoise/unet_layers.h"

#include <array>
#include <cstddef>

namespace blush::denoise {

// Element type of the multiplications. Sums are always float32.
enum class Element : unsigned char { float32, bfloat16 };
constexpr size_t bytes_of(Element element) { return element == Element::float32 ? 4 : 2; }

// In bfloat16 each colour channel is split into two parts with 16 bits in total, because with 8 bits an error in the last bit of
// the encoded value is up to 1 % of radiance. The input has this many more channels: the low parts of its first channels.
inline constexpr int split_channels = 3;
constexpr int extra_inputs(Element element) { return element == Element::float32 ? 0 : split_channels; }

// Rows of one layer's output that a worker computes at a time: few enough for its caches including the inputs, and independent of
// the number of workers.
inline constexpr int band_rows = 8;

// Pixels with interleaved channels, rows without gaps. A row of zeros precedes the first row and follows the last: the
// convolution's padding.
struct UnetPlane {
    int width = 0, height = 0, channels = 0;
    Element element = Element::float32;
    size_t offset = 0; // of the first row of zeros, in bytes

    size_t row_elements() const { return size_t(width) * channels; }
    size_t row_bytes() const { return row_elements() * bytes_of(element); }
};

struct UnetPlan {
    std::array<UnetPlane, unet_plane_count> planes = {}; // the last one is output row by row and not stored
    size_t plane_bytes = 0;                              // of all planes
    size_t band_bytes = 0;                               // per worker: input and output of a band

    size_t bytes(unsigned workers) const { return plane_bytes + workers * 2 * band_bytes; }
};

// Sides must be multiples of unet_side_multiple. The last layer reads and writes float32 whatever the `element` of the others: it
// is cheap, and no later layer averages its errors.
UnetPlan plan_unet(const UnetChannels& channels, int width, int height, Element element);

} // namespace blush::denoise
