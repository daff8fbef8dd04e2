// What a light does not light, and which shadow rays take no notice of whom.
#pragma once

#include "core/math.h"
#include "render/accel.h"
#include "render/scene_tables.h"

namespace blush::inline BLUSH_ISA {

// In place of a part that a ray leaves: the camera, which sees all lights, and a light meter, which is lit by all.
constexpr int32_t from_camera = -1, from_meter = -2;

// Does the light of that record light a surface of part `part`? Light -1 lights all.
template <class F> Mask<F> is_lit(const LinkTables& links, const Int<F>& light, const Int<F>& part, const Mask<F>& active) {
    const Mask<F> asked = active && as_mask(light >= 0) && as_mask(part >= 0);
    const Int<F> set = gather(links.lit_sets, select(asked, light, Int<F>(0)));
    const Mask<F> linked = asked && as_mask(set >= 0);
    if (!any(linked)) return Mask<F>(true);
    const Int<F> word = select(linked, Int<F>(set * links.words + (part >> 5)), Int<F>(0));
    const UInt<F> bit = (gather(links.lit_parts, word) >> to_unsigned(Int<F>(part & 31))) & 1u;
    return !linked || as_mask(bit != 0u);
}

// What a shadow ray towards a light meets.
template <class F> UInt<F> shadow_mask(const LinkTables& links, const Int<F>& light) { return gather(links.shadow_masks, light); }

// Not everything casts the light's shadow. A ray that a BSDF sends out does meet everything, so it must not find such a light: then light
// sampling has all of it, as of a light without size. Where a mirror sends it, nothing else could find the light, and it shows what is there.
template <class F> Mask<F> has_own_shadows(const LinkTables& links, const Int<F>& light, const Mask<F>& active) {
    const Mask<F> asked = active && as_mask(light >= 0);
    return asked && as_mask(shadow_mask<F>(links, select(asked, light, Int<F>(0))) != other_ray_mask);
}

// What becomes of the MIS weight of emission that a ray from part `from` found with density bsdf_pdf.
template <class F>
F linked_weight(const LinkTables& links, const F& weight, const Int<F>& light, const Int<F>& from, const F& bsdf_pdf, const Mask<F>& active) {
    const Mask<F> sampled = as_mask(from != from_camera) && bsdf_pdf != F(infinity);
    const Mask<F> counts = is_lit<F>(links, light, from, active) && !(sampled && has_own_shadows<F>(links, light, active));
    return select(counts, weight, F(0.f));
}

} // namespace blush::inline BLUSH_ISA
