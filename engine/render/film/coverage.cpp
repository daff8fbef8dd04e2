#include "render/film/coverage.h"

namespace blush {

float coverage_of_pixel(const Frame& frame, size_t pixel) {
    const float alpha = frame.rgba[4 * pixel + 3];
    if (alpha < 1) return alpha;
    return pixel < frame.object_id.size() && frame.object_id[pixel] == 0 ? 0.f : 1.f;
}

std::vector<float> opacity_of(const Frame& frame) {
    std::vector<float> opacity(frame.transparent ? frame.rgba.size() / 4 : 0);
    for (size_t i = 0; i < opacity.size(); ++i) opacity[i] = frame.rgba[4 * i + 3];
    return opacity;
}

std::vector<float> coverage_of(const Frame& frame) {
    std::vector<float> coverage(frame.rgba.size() / 4);
    for (size_t i = 0; i < coverage.size(); ++i) coverage[i] = coverage_of_pixel(frame, i);
    return coverage;
}

} // namespace blush
