// Everything the tables answer, for many points at once: instantiated per lane type and instruction set to compare bits.
#pragma once

#include "shading/environment.h"
#include "shading/material.h"

#include <array>
#include <cstdint>

namespace blush {

// Field i of point k is [i][k]; points in multiples of 16.
struct TablePoints {
    const MaterialTables* materials;
    const EnvironmentTables* environment;
    int count;
    std::array<const float*, 12> numbers; // uv0, uv1, vertex colour, direction, u
    const int32_t* material;
    const uint32_t* bits;
    const int32_t* active;
};
constexpr int table_answers = 35;

} // namespace blush

namespace blush::inline BLUSH_ISA {

template <class F> void evaluate_tables(const TablePoints& points, const std::array<float*, table_answers>& answers) {
    for (int k = 0; k < points.count; k += width<F>) {
        const auto number = [&](size_t i) { return load<F>(points.numbers[i] + k); };
        const Mask<F> active = as_mask(load<Int<F>>(points.active + k) != 0);
        const Vec2T<F> uv0{number(0), number(1)}, uv1{number(2), number(3)};
        const Vec<F> direction{number(8), number(9), number(10)};
        const MaterialPoint<F> m = material_at<all_features, F>(*points.materials, load<Int<F>>(points.material + k), uv0, uv1,
                                                                Vec4T<F>{number(4), number(5), number(6), number(7)}, active);
        const Vec<F> radiance = environment_radiance<F>(*points.environment, direction, active);
        const EnvironmentSample<F> s = sample_environment<F>(*points.environment, number(11), load<UInt<F>>(points.bits + k));
        const auto flag = [](const Mask<F>& b) { return select(b, F(1.f), F(0.f)); };
        const BsdfParams<F>& b = m.bsdf;
        const std::array<F, table_answers> all{
            b.base_color.x, b.base_color.y, b.base_color.z, b.metallic, b.roughness, b.ior, b.specular, b.specular_color.x, b.specular_color.y,
            b.specular_color.z, b.transmission, flag(b.thin), m.emission.x, m.emission.y, m.emission.z, m.tangent_normal.x, m.tangent_normal.y,
            m.tangent_normal.z, m.sigma_a.x, m.sigma_a.y, m.sigma_a.z, flag(m.double_sided), flag(m.unlit), flag(m.emissive), radiance.x,
            radiance.y, radiance.z, environment_pdf<F>(*points.environment, direction), s.direction.x, s.direction.y, s.direction.z, s.radiance.x,
            s.radiance.y, s.radiance.z, s.pdf};
        for (size_t i = 0; i < all.size(); ++i) store(answers[i] + k, all[i]);
    }
}

} // namespace blush::inline BLUSH_ISA
