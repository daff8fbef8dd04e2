// Directional emission of a light: the product of up to three factors.
//
//   cone    of a spot, KHR_lights_punctual's falloff: clamp(cos theta * scale + offset)^2, theta from the axis
//   spread  of an area light with a grid in front of it, which blocks more light at larger angles:
//           max(0, tan h - tan theta) / (tan h - h), h half the spread. The integral of it times the cosine over the hemisphere is pi
//           for any spread, so an area light keeps its luminous flux and gets brighter along its axis.
//   table   an IES profile (scene/lights/ies_profile.h), relative to its peak
#pragma once

#include "core/math.h"

#include <cstdint>

namespace blush {

struct ProfileRecord {
    Vec3 x, y, ahead;               // the light's frame in world space, unit vectors
    float cone_scale, cone_offset;  // 0 and 1: no cone
    float spread_tan, spread_scale; // tan h and 1 / (tan h - h); scale 0: no spread
    // into `numbers`: vertical angles, horizontal angles, then values, vertical fastest; -1: no table
    int32_t first, verticals, horizontals;
    int32_t polar_x; // the table's polar axis is the light's X (type B), not the light's own axis (type C)
};

struct ProfileTables {
    const ProfileRecord* records = nullptr; // null: no light has a profile
    const float* numbers = nullptr;         // angles in turns
};

} // namespace blush

namespace blush::inline BLUSH_ISA {

// The interval of `count` ascending numbers at `first` that contains x, and the position in it; `inside` is false beyond the
// ends. A single number applies everywhere.
template <class F> struct TablePlace {
    Int<F> below, above;
    F fraction;
    Mask<F> inside;
};
template <class F> TablePlace<F> place_in_table(const float* numbers, const Int<F>& first, const Int<F>& count, const F& x) {
    Int<F> low = 0, high = max(Int<F>(count - 2), Int<F>(0));
    while (any(as_mask(low < high))) {
        const Int<F> probe = (low + high + 1) >> 1;
        const Mask<F> below = gather(numbers, Int<F>(first + probe)) <= x;
        low = select(below, probe, low);
        high = select(below, high, Int<F>(probe - 1));
    }
    const Int<F> above = min(Int<F>(low + 1), Int<F>(count - 1));
    const F a = gather(numbers, Int<F>(first + low)), b = gather(numbers, Int<F>(first + above));
    const Mask<F> alone = as_mask(count < 2);
    return {low, above, select(alone, F(0.f), (x - a) / select(alone, F(1.f), b - a)), alone || (x >= a && x <= b)};
}

// The IES factor in a unit direction with these coordinates in the light's frame; 0 in lanes outside `active`.
template <class F>
F table_factor(const ProfileTables& tables, const Int<F>& profile, const F& x, const F& y, const F& ahead, const Mask<F>& active) {
    const auto field = [&](int32_t ProfileRecord::*f) { return gather_field(tables.records, f, profile); };
    const Int<F> first = select(active, field(&ProfileRecord::first), Int<F>(0));
    const Int<F> verticals = select(active, field(&ProfileRecord::verticals), Int<F>(1));
    const Int<F> horizontals = select(active, field(&ProfileRecord::horizontals), Int<F>(1));
    const Mask<F> polar_x = as_mask(field(&ProfileRecord::polar_x) != 0);
    const F turn = atan2_turns(y, x);
    // Rounding must not exceed a table's last angle.
    const F from_ahead = min(atan2_turns(F(sqrt(x * x + y * y)), ahead), F(0.5f));
    const F lateral = max(min(atan2_turns(x, F(sqrt(y * y + ahead * ahead))), F(0.25f)), F(-0.25f));
    const F vertical = select(polar_x, atan2_turns(y, ahead), from_ahead);
    const F horizontal = select(polar_x, lateral, min(select(turn < F(0.f), turn + 1.f, turn), F(1.f)));
    const TablePlace<F> v = place_in_table<F>(tables.numbers, first, verticals, vertical);
    const TablePlace<F> h = place_in_table<F>(tables.numbers, Int<F>(first + verticals), horizontals, horizontal);
    const Int<F> values = first + verticals + horizontals;
    const auto value = [&](const Int<F>& row, const Int<F>& column) {
        return gather(tables.numbers, Int<F>(values + row * verticals + column));
    };
    const F below = lerp(value(h.below, v.below), value(h.below, v.above), v.fraction);
    const F above = lerp(value(h.above, v.below), value(h.above, v.above), v.fraction);
    return select(active && v.inside && h.inside, lerp(below, above, h.fraction), F(0.f));
}

// The factor of a profile in the unit direction of emission; `profile`
// must be valid in every lane; results outside `active` are unused.
template <class F> F profile_factor(const ProfileTables& tables, const Int<F>& profile, const Vec<F>& direction, const Mask<F>& active) {
    const auto axis = [&](Vec3 ProfileRecord::*f) { return dot(gather_field3<F>(tables.records, f, profile), direction); };
    const F x = axis(&ProfileRecord::x), y = axis(&ProfileRecord::y), ahead = axis(&ProfileRecord::ahead);
    const F in_cone = clamp01(ahead * gather_field(tables.records, &ProfileRecord::cone_scale, profile) +
                              gather_field(tables.records, &ProfileRecord::cone_offset, profile));
    F factor = in_cone * in_cone;
    const F spread = gather_field(tables.records, &ProfileRecord::spread_scale, profile);
    // The grid of an area light acts on both sides.
    const F tangent = sqrt(x * x + y * y) / max(abs(ahead), F(1e-12f));
    const F left = max(gather_field(tables.records, &ProfileRecord::spread_tan, profile) - tangent, F(0.f)) * spread;
    factor = select(spread > F(0.f), factor * left, factor);
    const Mask<F> measured = active && as_mask(gather_field(tables.records, &ProfileRecord::first, profile) >= 0);
    if (any(measured)) factor = select(measured, factor * table_factor<F>(tables, profile, x, y, ahead, measured), factor);
    return factor;
}

} // namespace blush::inline BLUSH_ISA
