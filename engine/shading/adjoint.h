// Delta lobes for light paths. Radiance flows from wi to wo; a light path, whose wo points to the light, carries flux the other way.
// It needs the lobe as the viewer in wi sees it (Veach 1997, section 3.7.6), and not the one that it has sampled.
#pragma once

#include "shading/bsdf.h"

namespace blush::inline BLUSH_ISA {

// Share of the light from the layers below that the coat leaves towards `viewer`, in the surface's frame.
template <class F> F left_below_coat(const LayerParams<F>& m, const Mask<F>& solid, const Vec<F>& viewer) {
    const Mask<F> flipped = solid && viewer.z < F(0.f);
    const Vec<F> upper = flip_z(flipped, viewer);
    return 1.f - clearcoat_reflectance(m.clearcoat, max(dot(facing_coat_normal(m, flipped, upper), upper), F(grazing)));
}

// Factor from the weight of a delta lobe, sampled for wo with this `choice`, to that of flux from wo to wi per cosine to the shading
// normal. Refraction changes radiance, not flux (equation 5.14), and the solid angle of a beam. A coat takes light from the lobes
// below by the viewer's direction alone, and mirrors about its own normal.
template <Features S, class F>
F delta_adjoint(const Bsdf<F>& b, const LayerParams<F>& m, const Vec<F>& wo, const Vec<F>& wi, const F& choice) {
    F factor = abs(wo.z) / max(abs(wi.z), F(1e-6f));
    Mask<F> solid = Mask<F>(false);
    if constexpr (S.has(Feature::transmission)) {
        solid = b.solid;
        const Mask<F> crosses = solid && (wi.z > F(0.f)) != (wo.z > F(0.f));
        factor = select(crosses, factor / b.radiance_scale, factor);
    }
    if constexpr (S.has(Feature::clearcoat)) {
        const F below = factor * left_below_coat(m, solid, wi) / max(b.coat.left, F(1e-6f));
        factor = select(choice < b.coat.probability, F(1.f), below);
    }
    return factor;
}

} // namespace blush::inline BLUSH_ISA
