// The two half buffers of an image as input of the error estimate: row by row, channel by channel, in whole registers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <vector>

namespace blush {

// Four adjacent pixels, on every machine, so that sums do not depend on the register width. Arithmetic is the compiler's.
using Four = float __attribute__((vector_size(16)));

inline Four splat(float v) { return Four{v, v, v, v}; }
inline Four min(const Four& a, const Four& b) { return a < b ? a : b; }
inline Four max(const Four& a, const Four& b) { return a > b ? a : b; }
inline Four abs(const Four& v) { return max(v, -v); }
inline Four sqrt(const Four& v) { return Four{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])}; }
inline Four squared(const Four& v) { return v * v; }

inline Four load_four(const float* from) {
    Four v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
inline void store_four(float* to, const Four& v) { std::memcpy(to, &v, sizeof v); }

// A value per pixel of a row, with a margin on both ends that is initially 0.
class PixelRow {
public:
    static constexpr int step = 4, margin = step;

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

    HalfBufferRow() = default;
    explicit HalfBufferRow(int width)
        : a{PixelRow(width), PixelRow(width), PixelRow(width)}, b(a), own(a), weight_a(width), known(width), one_sample(width) {}
};

// An image that is read row by row; load(y, scale, row) gives the values of row y times `scale`.
struct HalfBufferImage {
    int width = 0, height = 0;
    std::function<void(int y, float scale, HalfBufferRow& row)> load;
};

} // namespace blush
