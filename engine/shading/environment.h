// Environment map: lat-long image with bilinear filtering, and importance sampling of directions.
//
// The map's centre column looks along -Z, its top row along +Y; to the right of the centre is +X. Radiance is interpolated
// between texel centres, so the density is constant on the cells between texel centres, not on texels: a cell is sampled with a
// probability proportional to the integral of the filtered map, a direction in it uniformly in solid angle. The pdf is p / solid
// angle. It needs no division by the sine of the polar angle, and is positive where the filtered map is positive.
#pragma once

#include "core/distribution.h"

namespace blush {

// A row of cells, from theta = `begin` to `end`. Heights are relative to the nearer pole, where cosines would lose their digits:
// a polar row of an 8k map spans less than the spacing of floats at 1.
struct EnvironmentRow {
    float begin, end; // sin^2(angle / 2), the angle measured from the nearer pole
    float pole;       // +1: from +Y, -1: from -Y
    float density;    // 1 / solid angle of a cell of this row, 1/sr
};

// Columns of cells wrap around: cell c is between the centres of texels c - 1 and c. There are height + 1 rows, the first and the
// last of half height between a pole and the centres of the adjacent texels. A constant environment is a map of 1 x 1 texel, no
// environment is a black one.
struct EnvironmentTables {
    const float* texels = nullptr;               // RGB >= 0, finite, top row first
    const uint32_t* row_thresholds = nullptr;    // height + 1
    const uint32_t* column_thresholds = nullptr; // width for each row of cells
    const int32_t* column_guides = nullptr;      // 2^guide_bits + 1 for each row of cells
    const EnvironmentRow* rows = nullptr;        // height + 1
    int32_t width = 0, height = 0, guide_bits = 1;
    Vec3 scale{0, 0, 0}; // radiance in nits of a texel of 1
    float rotation = 0;  // of the map about +Y, counter-clockwise seen from above, in turns, [-0.5, 0.5]
    int32_t visible_to_camera = 1;
    int32_t lights_scene = 1; // visible to all other rays
};

} // namespace blush

namespace blush::inline BLUSH_ISA {

template <class F> struct EnvironmentCell {
    Int<F> column, row;
    F x, y; // position in the cell, [0, 1): the weights of its right column and its lower row
};

// The cell in a direction of any length. Non-finite directions give an arbitrary cell.
template <class F> EnvironmentCell<F> environment_cell(const EnvironmentTables& env, const Vec<F>& direction) {
    const F width = to_float(Int<F>(env.width)), height = to_float(Int<F>(env.height));
    F u = atan2_turns(direction.x, F(-direction.z)) + (0.5f + env.rotation);
    u = u - floor(u);
    const F v = 2.f * atan2_turns(F(sqrt(direction.x * direction.x + direction.z * direction.z)), direction.y);
    const F x = min(max(u * width + 0.5f, F(0.f)), width + 0.5f);
    const F y = min(max(v * height + 0.5f, F(0.f)), height + 0.5f);
    const F column = floor(x), row = floor(y);
    const Int<F> c = to_int(column);
    return {select(as_mask(c >= env.width), Int<F>(0), c), min(to_int(row), Int<F>(env.height)), x - column, y - row};
}

// Radiance in nits; zero in inactive lanes.
template <class F> Vec<F> radiance_of_cell(const EnvironmentTables& env, const EnvironmentCell<F>& cell, const Mask<F>& active) {
    const Int<F> left = select(as_mask(cell.column == 0), Int<F>(env.width - 1), Int<F>(cell.column - 1)), right = cell.column;
    const Int<F> top = max(Int<F>(cell.row - 1), Int<F>(0)) * env.width;
    const Int<F> bottom = min(cell.row, Int<F>(env.height - 1)) * env.width;
    const Vec<F> above = lerp(gather3<F>(env.texels, top + left), gather3<F>(env.texels, top + right), cell.x);
    const Vec<F> below = lerp(gather3<F>(env.texels, bottom + left), gather3<F>(env.texels, bottom + right), cell.x);
    return select(active, lerp(above, below, cell.y) * splat<F>(env.scale), splat<F>(0.f));
}
template <class F> Vec<F> environment_radiance(const EnvironmentTables& env, const Vec<F>& direction, const Mask<F>& active) {
    if (!any(active)) return splat<F>(0.f);
    if (env.width == 1 && env.height == 1) // constant or none: the same without the angles
        return select(active, Vec<F>{F(env.texels[0]), F(env.texels[1]), F(env.texels[2])} * splat<F>(env.scale), splat<F>(0.f));
    return radiance_of_cell<F>(env, environment_cell<F>(env, direction), active);
}

template <class F> struct EnvironmentSample {
    Vec<F> direction; // unit, away from the scene
    Vec<F> radiance;  // nits
    F pdf;            // 1/sr
};

// Samples a direction. `u` in [0, 1) selects the row and the height in it, `bits` (all 32 uniform) the column and the azimuth.
template <class F> EnvironmentSample<F> sample_environment(const EnvironmentTables& env, const F& u, const UInt<F>& bits) {
    // u has only 24 bits; a hash adds more, so that rows rarer than 2^-24 are sampled with their exact probability.
    const UInt<F> upper = to_unsigned(to_int(F(u * 0x1p24f))) << 8;
    const DiscreteSample<F> row = sample_discrete<F>(env.row_thresholds, Int<F>(0), env.height + 1, upper | (pcg_hash(bits) & 255u));
    const DiscreteSample<F> column = sample_guided<F>(env.column_thresholds, row.index * env.width, env.width, env.column_guides,
                                                      row.index * ((1 << env.guide_bits) + 1), env.guide_bits, bits);

    const F begin = gather_field(env.rows, &EnvironmentRow::begin, row.index);
    const F end = gather_field(env.rows, &EnvironmentRow::end, row.index);
    const F s = begin + (end - begin) * row.remainder;
    const F sin_theta = 2.f * sqrt(max(F(0.f), s * (1.f - s)));
    const F cos_theta = gather_field(env.rows, &EnvironmentRow::pole, row.index) * (1.f - 2.f * s);
    const F azimuth = (to_float(column.index) - 0.5f + column.remainder) / to_float(Int<F>(env.width)) - (0.5f + env.rotation);
    const SinCos<F> a = sincos_turns(azimuth);
    const Vec<F> direction{sin_theta * a.sin, cos_theta, -(sin_theta * a.cos)};
    return {direction, environment_radiance<F>(env, direction, Mask<F>(true)),
            row.probability * column.probability * gather_field(env.rows, &EnvironmentRow::density, row.index)};
}

// The pdf, 1/sr, of sample_environment for a direction.
template <class F> F pdf_of_cell(const EnvironmentTables& env, const EnvironmentCell<F>& cell) {
    const F p_row = discrete_probability<F>(env.row_thresholds, Int<F>(0), Int<F>(env.height + 1), cell.row);
    const F p_column = discrete_probability<F>(env.column_thresholds, Int<F>(cell.row * env.width), Int<F>(env.width), cell.column);
    return p_row * p_column * gather_field(env.rows, &EnvironmentRow::density, cell.row);
}
template <class F> F environment_pdf(const EnvironmentTables& env, const Vec<F>& direction) {
    return pdf_of_cell<F>(env, environment_cell<F>(env, direction));
}

} // namespace blush::inline BLUSH_ISA
