#include "color/illuminance.h"

#include "core/math.h"

namespace blush {

void to_illuminance(std::span<float> rgb, std::span<const Vec3> albedo) {
    for (size_t i = 0; i < albedo.size() && 3 * i + 2 < rgb.size(); ++i) {
        float* p = &rgb[3 * i];
        const float reflected = luminance(albedo[i]);
        p[0] = p[1] = p[2] = reflected >= 0.01f ? pi * luminance(Vec3{p[0], p[1], p[2]}) / reflected : 0;
    }
}

} // namespace blush
