#include "color/false_color.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr Vec3 bytes(int r, int g, int b) { return {float(r) / 255, float(g) / 255, float(b) / 255}; }

} // namespace

const std::array<Vec3, false_color_bands + 2> false_colors{
    {bytes(0, 0, 0), bytes(52, 10, 84), bytes(98, 32, 160), bytes(52, 52, 214), bytes(24, 116, 232), bytes(24, 182, 214),
     bytes(20, 136, 96), bytes(128, 128, 128), bytes(116, 204, 64), bytes(244, 230, 40), bytes(248, 178, 24), bytes(242, 112, 20),
     bytes(220, 32, 28), bytes(255, 128, 190), bytes(255, 255, 255)}};

int false_color_band(float luminance, const FalseColorScale& scale) {
    if (!(luminance > 0)) return 0;
    const float t = (std::log2(luminance) - scale.low) / (scale.high - scale.low);
    return int(std::clamp(std::floor(t * false_color_bands) + 1, 0.f, float(false_color_bands + 1)));
}

float false_color_edge(int band, const FalseColorScale& scale) {
    return scale.low + (scale.high - scale.low) * float(band - 1) / false_color_bands;
}

} // namespace blush
