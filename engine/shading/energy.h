// Energy loss of the microfacet model: light from a microfacet that hits another one is masked instead of scattered again. The
// table holds what remains, the directional albedo E of a GGX reflector with Fresnel reflectance 1. Scaling a lobe as in Turquin
// 2019, "Practical multiple scattering compensation for microfacet models", restores it: by 1 / E for full reflection, by 1 + F0
// (1 / E - 1) for reflectance F0. The scale depends on wo alone, so the compensated lobe is not reciprocal.
#pragma once

#include "shading/bilinear.h"

namespace blush {

// E over perceptual roughness (rows, 0 to 1) and a stretched cosine (columns): see directional_albedo.
struct EnergyTable {
    static constexpr int size = 32;
    static constexpr float relative_error = 1e-3f; // of an interpolated value at most, for roughness >= 0.01
    float albedo[size * size];
};

// By quadrature, deterministic; a few milliseconds.
EnergyTable make_energy_table();

} // namespace blush

namespace blush::inline BLUSH_ISA {

// E for a viewer at cosine `cos` > 0. Masking begins where cos ~ alpha: the column cos (1 + alpha) / (cos + alpha) keeps half of
// the table for cosines below alpha at every roughness.
template <class F> F directional_albedo(const EnergyTable& table, const F& roughness, const F& cos) {
    constexpr float last = float(EnergyTable::size - 1);
    const F alpha = roughness * roughness;
    const F row = clamp01(roughness) * last, column = clamp01(F(cos * (1.f + alpha) / (cos + alpha))) * last;
    return bilinear(table.albedo, EnergyTable::size, row, column);
}

} // namespace blush::inline BLUSH_ISA
