// All table lookups for many points, instantiated per lane type and instruction set to compare bits.
#pragma once

#include "shading/environment.h"
#include "shading/material.h"
#include "tests/shading/numbers.h"

#include <array>
#include <cstdint>

namespace blush {

// Field i of point k is [i][k]; points in multiples of 16.
struct TablePoints {
    const MaterialTables* materials;
    const EnvironmentTables* environment;
    int count;
    std::array<const float*, 14> numbers; // two UV sets, vertex colour, direction, u, width on each UV set
    const int32_t* material;
    const uint32_t* bits;
    const int32_t* active;
};
constexpr int table_answers = numbers_of_params + 33;

} // namespace blush

namespace blush::inline BLUSH_ISA {

template <class F> void evaluate_tables(const TablePoints& points, const std::array<float*, table_answers>& answers) {
    for (int k = 0; k < points.count; k += width<F>) {
        const auto number = [&](size_t i) { return load<F>(points.numbers[i] + k); };
        const Mask<F> active = as_mask(load<Int<F>>(points.active + k) != 0);
        const TexturePoint<F> at{.uv = {{{number(0), number(1)}, {number(2), number(3)}}}, .width = {{number(12), number(13)}}};
        const Vec<F> direction{number(8), number(9), number(10)};
        const MaterialPoint<F> m = material_at<all_features, F>(*points.materials, load<Int<F>>(points.material + k), at,
                                                                Vec4T<F>{number(4), number(5), number(6), number(7)}, active);
        const Vec<F> radiance = environment_radiance<F>(*points.environment, direction, active);
        const EnvironmentSample<F> s = sample_environment<F>(*points.environment, number(11), load<UInt<F>>(points.bits + k));
        const BsdfParams<F>& b = m.bsdf;

        size_t next = 0;
        const auto put = [&](const F& x) { store(answers[next++] + k, x); };
        const auto put_flag = [&](const Mask<F>& x) { put(select(x, F(1.f), F(0.f))); };
        const auto put_vec = [&](const Vec<F>& v) {
            for (const F& x : {v.x, v.y, v.z}) put(x);
        };
        for_each_value(b, put);
        for (const Vec<F>& v : {m.emission, m.tangent_normal, m.clearcoat_tangent_normal, m.sigma_a}) put_vec(v);
        for (const F& x : {m.anisotropy.strength, m.anisotropy.direction.x, m.anisotropy.direction.y, m.dispersion}) put(x);
        for (const Mask<F>& x : {b.thin, m.double_sided, m.unlit}) put_flag(x);
        for (const Vec<F>& v : {radiance, s.direction, s.radiance}) put_vec(v);
        for (const F& x : {s.pdf, environment_pdf<F>(*points.environment, direction)}) put(x);
    }
}

} // namespace blush::inline BLUSH_ISA
