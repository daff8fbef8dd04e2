#include "shading/sheen.h"

namespace blush {
namespace {

// E by midpoint quadrature over the hemisphere, finer towards the horizon,
// where smooth fibres reflect; by symmetry half the azimuths suffice.
float integrate_sheen_albedo(float alpha, float cos) {
    constexpr int azimuths = 32, heights = 64;
    static_assert(heights % width<Wide> == 0);
    const Vec<Wide> wo = splat<Wide>(Vec3{sqrt(max(0.f, (1.f - cos) * (1.f + cos))), 0, cos});
    Wide sum = 0.f;
    for (int i = 0; i < azimuths; ++i) {
        const SinCos<float> azimuth = sincos_turns((float(i) + 0.5f) / (2 * azimuths));
        for (int j = 0; j < heights; j += width<Wide>) {
            const Wide w = (to_float(iota<Wide>() + j) + 0.5f) / float(heights); // z = w^2, dz = 2 w dw
            const Wide z = w * w, r = sqrt(1.f - z * z);
            sum += 2.f * w * charlie_f_cos(Wide(alpha), wo, Vec<Wide>{r * azimuth.cos, r * azimuth.sin, z});
        }
    }
    return sum_lanes(sum) * (2 * pi) / (azimuths * heights);
}

SheenTable make_sheen_table() {
    constexpr int size = SheenTable::size;
    SheenTable table;
    for (int row = 0; row < size; ++row) {
        const float t = float(row) / (size - 1), roughness = min_sheen_roughness + (1.f - min_sheen_roughness) * t * t;
        for (int column = 0; column < size; ++column) {
            const float root = max(float(column) / (size - 1), 0.01f);
            table.albedo[row * size + column] = integrate_sheen_albedo(roughness * roughness, root * root * root * root);
        }
    }
    return table;
}

} // namespace

const SheenTable& sheen_table() {
    static const SheenTable table = make_sheen_table();
    return table;
}

} // namespace blush
