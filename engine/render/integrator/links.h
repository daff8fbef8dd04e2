// Light linking in kernels: which lights illuminate a surface, and which objects a shadow ray can hit.
#pragma once

#include "core/math.h"
#include "render/bvh/accel.h"
#include "render/compile/scene_tables.h"

namespace blush::inline BLUSH_ISA {

// Part index for rays from the camera, which sees all lights, and from a light meter, which all lights illuminate.
constexpr int32_t from_camera = -1, from_meter = -2;

// True if the light of that record illuminates part `part`. Light -1 illuminates all.
template <class F> Mask<F> is_lit(const LinkTables& links, const Int<F>& light, const Int<F>& part, const Mask<F>& active) {
    const Mask<F> queried = active && as_mask(light >= 0) && as_mask(part >= 0);
    const Int<F> set = gather(links.lit_sets, select(queried, light, Int<F>(0)));
    const Mask<F> linked = queried && as_mask(set >= 0);
    if (!any(linked)) return Mask<F>(true);
    const Int<F> word = select(linked, Int<F>(set * links.words + (part >> 5)), Int<F>(0));
    const UInt<F> bit = (gather(links.lit_parts, word) >> to_unsigned(Int<F>(part & 31))) & 1u;
    return !linked || as_mask(bit != 0u);
}

// Mask of a shadow ray towards the light.
template <class F> UInt<F> shadow_mask(const LinkTables& links, const Int<F>& light) { return gather(links.shadow_masks, light); }

// True if shadow linking applies to the light. BSDF-sampled rays hit all objects, so they must not count emission of such a
// light: NEE gets the full weight, as for delta lights. Behind a delta lobe, only the ray can find the light, so it is counted;
// and so light paths leave their first surface by delta lobes alone.
template <class F> Mask<F> has_own_shadows(const LinkTables& links, const Int<F>& light, const Mask<F>& active) {
    const Mask<F> queried = active && as_mask(light >= 0);
    return queried && as_mask(shadow_mask<F>(links, select(queried, light, Int<F>(0))) != other_ray_mask);
}

// MIS weight, adjusted for light linking, of emission hit by a ray from part `from` with density bsdf_pdf.
template <class F> F linked_weight(const LinkTables& links, const F& weight, const Int<F>& light, const Int<F>& from, const F& bsdf_pdf,
                                   const Mask<F>& active) {
    const Mask<F> sampled = as_mask(from != from_camera) && bsdf_pdf != F(infinity);
    const Mask<F> counts = is_lit<F>(links, light, from, active) && !(sampled && has_own_shadows<F>(links, light, active));
    return select(counts, weight, F(0.f));
}

} // namespace blush::inline BLUSH_ISA
