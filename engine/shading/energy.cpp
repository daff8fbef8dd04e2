#include "shading/energy.h"

#include "shading/microfacet.h"

namespace blush {

namespace {

// E = mean of masking(wi) over visible normals: the sampling density cancels all other terms. Mean over a grid of midpoints,
// finer near v = 1, where the distribution has a long tail; by symmetry half the azimuths suffice.
float integrate_ggx_albedo(float alpha, float cos) {
    constexpr int azimuths = 16, heights = 64;
    static_assert(heights % width<Wide> == 0);
    const float sin = sqrt(max(0.f, (1.f - cos) * (1.f + cos)));
    const Vec<Wide> wo = splat<Wide>(Vec3{sin, 0, cos});
    Wide sum = 0.f;
    for (int i = 0; i < azimuths; ++i)
        for (int j = 0; j < heights; j += width<Wide>) {
            const Wide u = (float(i) + 0.5f) / (2 * azimuths);
            const Wide w = (to_float(iota<Wide>() + j) + 0.5f) / float(heights); // v = 1 - w^2, dv = 2 w dw
            const Vec<Wide> h = sample_visible_normal(Wide(alpha), wo, u, 1.f - w * w);
            const Vec<Wide> wi = h * (2.f * dot(wo, h)) - wo;
            sum += select(wi.z > 0.f, 2.f * w * masking(Wide(alpha), wi), Wide(0.f));
        }
    return sum_lanes(sum) / (azimuths * heights);
}

} // namespace

EnergyTable make_energy_table() {
    constexpr int size = EnergyTable::size;
    EnergyTable table;
    for (int row = 0; row < size; ++row) {
        const float roughness = max(float(row) / (size - 1), smooth_roughness);
        const float alpha = roughness * roughness;
        for (int column = 0; column < size; ++column) {
            const float y = float(column) / (size - 1);
            table.albedo[row * size + column] = integrate_ggx_albedo(alpha, min(alpha * y / (1.f + alpha - y), 1.f));
        }
    }
    return table;
}

} // namespace blush
