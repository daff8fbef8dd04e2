// KHR_materials_clearcoat: a colourless GGX reflection of index 1.5 on top of everything else, with its own normal. The light
// that it reflects towards the viewer, by the cosine between viewer and coat normal, is taken from the layers below: the layers
// together never reflect more than they receive. As in the specification, the split depends on the viewer alone, so the coated
// material is not reciprocal.
#pragma once

#include "shading/bsdf_types.h"
#include "shading/energy.h"
#include "shading/microfacet.h"

namespace blush::inline BLUSH_ISA {

constexpr float clearcoat_f0 = 0.04f; // of index 1.5

// Reflectance of a coat with coverage `clearcoat` towards a viewer at this cosine.
template <class F> F clearcoat_reflectance(const F& clearcoat, const F& cos) {
    return clearcoat * (clearcoat_f0 + (1.f - clearcoat_f0) * schlick(cos));
}

// Transmittance of the coat for the surface's own emission. Uses the geometric normal, so that NEE and emission hits agree.
template <class F> F through_clearcoat(const F& clearcoat, const F& cos) { return 1.f - clearcoat_reflectance(clearcoat, cos); }

// The coat's normal in the viewer's frame, or z if it does not face the viewer. `wo`: as upper_wo. For a viewer inside, it is flipped.
template <class F> Vec<F> facing_coat_normal(const LayerParams<F>& m, const Mask<F>& flipped, const Vec<F>& wo) {
    const Vec<F>&n = m.clearcoat_normal, z{F(0.f), F(0.f), F(1.f)};
    const Vec<F> towards{select(flipped, -n.x, n.x), select(flipped, -n.y, n.y), n.z};
    return select<F>(dot(towards, wo) > F(min_facing), towards, z);
}

// Sets everything except the probability.
template <Features S, class F>
Clearcoat<F> make_clearcoat(const Bsdf<F>& b, const LayerParams<F>& m, const Vec<F>& wo_surface, const EnergyTable* energy) {
    Clearcoat<F> coat;
    const Vec<F> wo = upper_wo(b, wo_surface);
    coat.frame = basis_around(facing_coat_normal(m, b.flipped, wo));
    coat.wo = coat.frame.to_local(wo);
    coat.wo.z = max(coat.wo.z, F(grazing));
    coat.reflected = clearcoat_reflectance(m.clearcoat, coat.wo.z);
    coat.left = 1.f - coat.reflected;
    coat.smooth = m.clearcoat_roughness < F(smooth_roughness);
    coat.alpha = max(F(m.clearcoat_roughness * m.clearcoat_roughness), F(smooth_roughness * smooth_roughness));
    coat.visible = masking_over_cos(coat.alpha, coat.wo);
    if constexpr (S.has(Feature::energy_compensation))
        if (energy)
            coat.reflected = coat.reflected / select(coat.smooth, F(1.f), directional_albedo(*energy, m.clearcoat_roughness, coat.wo.z));
    return coat;
}

// Value and pdf of the coat alone, without its sampling probability; wi in the viewer's frame.
template <class F> BsdfValue<F> eval_clearcoat(const Clearcoat<F>& coat, const Vec<F>& wi_viewer) {
    const Vec<F> wi = coat.frame.to_local(wi_viewer);
    const Vec<F> sum = coat.wo + wi;
    const Vec<F> h = sum / sqrt(max(length_squared(sum), F(1e-30f)));
    // The coat scatters nothing below the surface, even if its normal is tilted.
    const Mask<F> above = wi.z > F(0.f) && wi_viewer.z > F(0.f) && !coat.smooth && coat.reflected > F(0.f);
    const F pdf = select(above, ggx(coat.alpha, h) * coat.visible * 0.25f, F(0.f));
    return {splat<F>(1.f) * (coat.reflected * pdf * masking(coat.alpha, wi)), pdf};
}

// Samples a direction in the viewer's frame; sets the weight only for a delta lobe.
template <class F> BsdfSample<F> draw_clearcoat(const Clearcoat<F>& coat, const F& u, const F& v) {
    const Vec<F> z{F(0.f), F(0.f), F(1.f)};
    const Vec<F> h = select(coat.smooth, z, sample_visible_normal(coat.alpha, coat.wo, u, v));
    const Vec<F> wi = h * (2.f * max(dot(coat.wo, h), F(grazing))) - coat.wo;
    BsdfSample<F> s;
    s.wi = coat.frame.to_world(wi);
    s.weight = splat<F>(1.f) * coat.reflected;
    s.pdf = F(1.f);
    s.delta = coat.smooth;
    s.valid = wi.z > F(0.f) && s.wi.z > F(0.f);
    return s;
}

} // namespace blush::inline BLUSH_ISA
