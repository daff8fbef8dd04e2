// The two half buffers of an image as input of the error estimate: row by row, channel by channel, in whole registers.
#pragma once

#include "core/lanes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace blush {

// The error estimate is compiled for the baseline only: four adjacent pixels a register on every machine, so that sums do not
// depend on its width.
static_assert(width<Wide> == 4);
inline Wide squared(const Wide& v) { return v * v; }

// A value per pixel of a row, with a margin on both ends that is initially 0.
class PixelRow {
public:
    static constexpr int step = width<Wide>, margin = step;

    PixelRow() = default;
    explicit PixelRow(int width) : values_(size_t(width + 3 * margin)) {}

    // Points to pixel 0; valid from -margin to a margin beyond the last whole step.
    float* pixels() { return values_.data() + margin; }
    const float* pixels() const { return values_.data() + margin; }
    void clear() { std::fill(values_.begin(), values_.end(), 0.f); }
    float& operator[](int x) { return pixels()[x]; }
    float operator[](int x) const { return pixels()[x]; }

private:
    std::vector<float> values_;
};

// Red, green, blue.
using ChannelRows = std::array<PixelRow, 3>;

struct HalfBufferRow {
    ChannelRows a, b, own; // means of the halves, and the image's values
    PixelRow weight_a;     // weight of a in the image
    PixelRow known;        // 1 where both halves hold samples; elsewhere 0, and a and b are the image's value
    PixelRow one_sample;   // where known, 1 / (number of samples of both); elsewhere 0
    // Share of the pixel's mean of one sample of a lamp that the camera sees: less where it takes more of them.
    PixelRow one_emission_sample;

    HalfBufferRow() = default;
    explicit HalfBufferRow(int width)
        : a{PixelRow(width), PixelRow(width), PixelRow(width)}, b(a), own(a), weight_a(width), known(width), one_sample(width),
          one_emission_sample(width) {}
};

// An image that is read row by row; load(y, scale, row) gives the values of row y times `scale`.
struct HalfBufferImage {
    int width = 0, height = 0;
    std::function<void(int y, float scale, HalfBufferRow& row)> load;
};

} // namespace blush
