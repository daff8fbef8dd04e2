// The delta lobes of a BSDF one by one, for paths that follow all of them (render/integrator/delta_chains.h). sample() selects one.
#pragma once

#include "shading/bsdf.h"

#include <array>

namespace blush::inline BLUSH_ISA {

template <class F> struct DeltaLobe {
    Vec<F> wi;     // in the frame of the surface
    Vec<F> value;  // reflectance or transmittance; as BsdfSample::weight, but not over the probability
    F probability; // with which sample() selects the lobe
    Mask<F> valid; // false: the surface does not have it
};
enum DeltaLobeKind : size_t { delta_transmission, delta_reflection, delta_coat, num_delta_lobes };

// All delta lobes of a point for the viewer of make_bsdf. u, v: uniform in [0, 1), select the microfacet of a rough surface whose
// transmission is a delta lobe nevertheless. The sum over lobes of the expected value is the expectation of sample() over its delta lobes.
template <Features S, class F>
std::array<DeltaLobe<F>, num_delta_lobes> delta_lobes(const Bsdf<F>& b, const Vec<F>& wo_surface, const F& u, const F& v) {
    std::array<DeltaLobe<F>, num_delta_lobes> lobes;
    for (DeltaLobe<F>& lobe : lobes) lobe = {splat<F>(0.f), splat<F>(0.f), F(0.f), Mask<F>(false)};
    if constexpr (has_facets(S)) {
        const Vec<F> z{F(0.f), F(0.f), F(1.f)}, wo = upper_wo(b, wo_surface);
        F p_facets = 1.f - b.p_diffuse;
        if constexpr (has_layers(S)) p_facets = p_facets * b.p_base;
        Vec<F> h = z;
        if (!all(b.smooth)) h = select<F>(b.smooth, z, sample_visible_normal(alpha_of<S>(b), wo, u, v));
        F cos = max(dot(wo, h), F(grazing));
        const FacetAlbedo<F> a = facet_albedo<S>(b, cos);
        const auto set = [&](DeltaLobeKind kind, const Vec<F>& wi, const Vec<F>& albedo, const Mask<F>& reflects, const Mask<F>& delta) {
            lobes[kind].wi = flip_z(b.flipped, wi);
            lobes[kind].value = albedo * left_for_base<S>(b, wi);
            lobes[kind].probability = p_facets * facet_probability<S>(a, reflects);
            lobes[kind].valid = delta && lobes[kind].probability > F(0.f);
        };
        const Vec<F> mirrored = h * (2.f * cos) - wo;
        set(delta_reflection, mirrored, a.reflected, Mask<F>(true), b.smooth && mirrored.z > F(0.f));
        if constexpr (S.has(Feature::transmission)) {
            h = select<F>(b.straight, z, h);
            cos = select(b.straight, b.cos, cos);
            const Vec<F> through = select<F>(b.solid, refract(b.interface, wo, h, cos), flip_z(Mask<F>(true), mirrored));
            set(delta_transmission, through, a.transmitted * b.radiance_scale, Mask<F>(false),
                (b.smooth || b.straight) && through.z < F(0.f) && dot(wo, h) > F(0.f));
        }
    }
    if constexpr (S.has(Feature::clearcoat)) {
        const Mask<F> smooth = b.coat.smooth && b.coat.probability > F(0.f);
        if (any(smooth)) {
            const BsdfSample<F> coat = draw_clearcoat(b.coat, u, v);
            lobes[delta_coat] = {flip_z(b.flipped, coat.wi), coat.weight, b.coat.probability, smooth && coat.valid};
        }
    }
    return lobes;
}

} // namespace blush::inline BLUSH_ISA
