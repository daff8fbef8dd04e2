// How a surface point scatters light: the material of glTF 2.0 Appendix B with KHR_materials_ior, _specular, _transmission and
// _volume, as one triple (make_bsdf, then eval / sample) of two parts: a Lambertian one, and GGX facets, each of which
// reflects or transmits.
//
// Local frame: z is the shading normal; directions are unit and point away from the surface. Of a surface that does not
// transmit into a solid, wo.z > 0. Of a solid's (transmission, not thin) z points out of it, and wo.z < 0 is a viewer within.
//
// What S leaves out is not computed, and what a material does not use changes no bit: every factor it then meets is an exact
// 1, every summand an exact 0.
#pragma once

#include "core/sampling.h"
#include "shading/energy.h"
#include "shading/features.h"
#include "shading/fresnel.h"
#include "shading/microfacet.h"

namespace blush::inline BLUSH_ISA {

// Scattering at a surface point, textures already applied. Colours are linear Rec.709.
template <class F> struct BsdfParams {
    Vec<F> base_color; // reflectance of the diffuse or metallic, tint of the transmitting share
    F metallic;
    F roughness; // perceptual: alpha is its square
    F ior;       // of the material in vacuum, >= 1; or 0, which reflects like a mirror (KHR_materials_ior)
    F specular;  // KHR_materials_specular; 0 has no dielectric reflection at all
    Vec<F> specular_color;
    F transmission; // KHR_materials_transmission
    Mask<F> thin;   // transmits without refraction, having no inside
};

// Lobes that scatter into one direction only (delta lobes) are seen by sample() alone.
template <class F> struct BsdfValue {
    Vec<F> f_cos; // f |wi.z|, 1/sr
    F pdf;        // of sample(), per solid angle
};

template <class F> struct BsdfSample {
    Vec<F> wi;
    Vec<F> weight; // f |wi.z| / pdf over all lobes but the delta ones; of a delta lobe its reflectance over its probability
    F pdf;         // as eval's; 1 for a delta lobe
    Mask<F> delta;
    Mask<F> valid; // false: no direction, weight 0
};

// Prepared by make_bsdf for a point and a viewer.
template <class F> struct Bsdf {
    Vec<F> diffuse;     // albedo of the Lambertian part below the Fresnel reflection
    Mask<F> delta_only; // no part has a density
    // Only where S has facets:
    Vec<F> metal_color, metal_gain; // reflects metal_gain * Schlick(metal_color)
    Vec<F> f0, dielectric_gain;     // ... + dielectric_gain * specular * Fresnel(f0)
    Vec<F> transmitted;             // what is not reflected by the dielectric goes through, times this
    F specular, alpha;
    F cos;                  // |wo.z|
    F visible;              // masking(wo) / |wo.z|
    Interface<F> interface; // of a solid
    F interface_f0;         // its reflectance at normal incidence
    F radiance_scale;       // of light that goes through
    F p_diffuse;            // probability of sampling the Lambertian part
    Mask<F> solid, flipped; // flipped: the viewer is below z = 0
    Mask<F> mirror;         // ior 0: a solid lets nothing in
    Mask<F> smooth;         // facets all face z: reflection and thin transmission are deltas
    Mask<F> straight;       // a solid refracts by less than single precision resolves: transmission is a delta
};

// Smaller cosines between the viewer and a surface or facet count as this one.
constexpr float grazing = 1e-6f;

constexpr bool has_facets(Features s) { return s.has(Feature::specular) || s.has(Feature::transmission); }

// ---- facets: what one with cosine c = dot(wo, h) > 0 does

template <class F> struct FacetAlbedo {
    F layer;            // largest component of the dielectric's reflectance: what its base does not get
    Vec<F> reflected;   // into the mirror direction
    Vec<F> transmitted; // through the surface
};

// Appendix B uses Schlick's approximation, and so do we, but for solids: there total internal reflection must be right, and
// seen from both sides the same light must split in the same ratio. For them Fresnel's curve replaces Schlick's between f0
// and 1 (which Appendix B's non-normative section on implementation leaves open), so that specular and specular_color mean the same.
template <Features S, class F> FacetAlbedo<F> facet_albedo(const Bsdf<F>& b, const F& c) {
    const F rise = schlick(c);
    F dielectric_rise = rise;
    Mask<F> total = Mask<F>(false);
    if constexpr (S.has(Feature::transmission)) {
        // Light that passes straight has seen no facets: the surface decides whether and how much is left to reflect.
        const F at = select(b.straight, b.cos, c);
        const F exact = clamp01(F((dielectric_reflectance(b.interface, at) - b.interface_f0) / max(F(1.f - b.interface_f0), F(1e-6f))));
        dielectric_rise = select(b.solid, exact, rise);
        total = b.solid && (b.mirror || totally_reflects(b.interface, at));
    }
    const Vec<F> one = splat<F>(1.f);
    const Vec<F> fresnel = select(total, one, (b.f0 + (one - b.f0) * dielectric_rise) * b.specular);
    const Vec<F> metal = b.metal_color + (one - b.metal_color) * rise;
    const F layer = max_component(fresnel);
    FacetAlbedo<F> a{layer, fresnel * b.dielectric_gain + metal * b.metal_gain, splat<F>(0.f)};
    if constexpr (S.has(Feature::transmission)) a.transmitted = b.transmitted * (1.f - layer);
    return a;
}

// Probability with which a sampled facet reflects, or else transmits.
template <Features S, class F> F facet_probability(const FacetAlbedo<F>& a, const Mask<F>& reflects) {
    const F certain = select(reflects, F(1.f), F(0.f));
    if constexpr (!S.has(Feature::transmission)) return certain;
    const F r = max_component(a.reflected), t = max_component(a.transmitted);
    return select(t > F(0.f), select(reflects, r, t) / (r + t), certain);
}

// ---- make

template <Features S, class F> void make_facets(Bsdf<F>& b, const BsdfParams<F>& m, const Vec<F>& wo, const EnergyTable* energy) {
    const Vec<F> one = splat<F>(1.f);
    b.cos = max(abs(wo.z), F(grazing));
    b.solid = S.has(Feature::transmission) ? m.transmission > F(0.f) && !m.thin : Mask<F>(false);
    b.flipped = b.solid && wo.z < F(0.f);
    b.smooth = m.roughness < F(smooth_roughness);
    b.alpha = max(F(m.roughness * m.roughness), F(smooth_roughness * smooth_roughness));
    b.visible = masking_over_cos(b.alpha, Vec<F>{wo.x, wo.y, b.cos});

    b.metal_color = m.base_color;
    b.specular = m.specular;
    const Vec<F> f0 = m.specular_color * normal_reflectance(m.ior);
    b.f0 = {min(f0.x, F(1.f)), min(f0.y, F(1.f)), min(f0.z, F(1.f))};
    b.metal_gain = one * m.metallic;
    b.dielectric_gain = one * (1.f - m.metallic);
    if constexpr (S.has(Feature::energy_compensation)) {
        if (energy) {
            const F lost = select(b.smooth, F(0.f), 1.f / directional_albedo(*energy, m.roughness, b.cos) - 1.f);
            b.metal_gain = b.metal_gain * (one + b.metal_color * lost);
            b.dielectric_gain = b.dielectric_gain * (one + b.f0 * (b.specular * lost));
        }
    }

    b.radiance_scale = F(1.f);
    b.straight = Mask<F>(false);
    if constexpr (S.has(Feature::transmission)) {
        const F ior = max(m.ior, F(1.f));
        b.transmitted = m.base_color * ((1.f - m.metallic) * m.transmission);
        b.interface = interface_seen(b.flipped, ior);
        b.interface_f0 = normal_reflectance(ior);
        // Radiance is squeezed into the smaller solid angle of the denser side: L / eta^2 is what refraction keeps (Veach 1997,
        // section 5.2). A path that comes out again has both factors, and a glass ball in a furnace is as bright as the furnace.
        b.radiance_scale = select(b.solid, 1.f / (b.interface.eta * b.interface.eta), F(1.f));
        b.mirror = m.ior < F(1.f);
        b.straight = b.solid && (b.smooth || b.alpha * (ior - 1.f) < F(1e-5f));
    }
}

// The facets' share of samples follows what the parts reflect towards wo. On a rough surface the facets in view are less
// grazing than the surface, hence the cosine; the bounds keep the weights bounded where the estimate is off.
template <Features S, class F> void choose_probabilities(Bsdf<F>& b, const BsdfParams<F>& m) {
    const FacetAlbedo<F> a = facet_albedo<S>(b, F(b.cos + (1.f - b.cos) * (0.5f * b.alpha)));
    const F diffuse = max_component(b.diffuse) * (1.f - a.layer);
    const F facets = max(max_component(a.reflected), max_component(a.transmitted));
    const F p = min(max(diffuse / max(diffuse + facets, F(1e-20f)), F(0.1f)), F(0.9f));
    // From the parameters: a facet that reflects nothing at one angle may at another.
    const Mask<F> no_diffuse = !(max_component(b.diffuse) > F(0.f));
    const Mask<F> no_facets = !(m.metallic > F(0.f) || m.specular > F(0.f) || m.transmission > F(0.f));
    b.p_diffuse = select(no_facets, F(1.f), select(no_diffuse, F(0.f), p));
    b.delta_only = no_diffuse && (no_facets || b.smooth);
}

// `energy`: scale facet reflection by what the microfacet model loses; null (or S without energy_compensation): do not.
template <Features S, class F> Bsdf<F> make_bsdf(const BsdfParams<F>& m, const Vec<F>& wo, const EnergyTable* energy) {
    Bsdf<F> b{};
    if constexpr (has_facets(S)) {
        b.diffuse = m.base_color * ((1.f - m.metallic) * (1.f - m.transmission));
        make_facets<S>(b, m, wo, energy);
        choose_probabilities<S>(b, m);
    } else {
        b.diffuse = m.base_color;
        b.delta_only = !(max_component(b.diffuse) > F(0.f));
    }
    return b;
}

// True where nothing has a density: eval is 0 for every direction, and light sampling would be wasted.
// True where all that is scattered is scattered alike to all viewers: reflectance b.diffuse.
template <Features S, class F> Mask<F> is_lambertian(const Bsdf<F>& b) {
    if constexpr (has_facets(S)) return b.p_diffuse == F(1.f);
    else return Mask<F>(true);
}
template <class F> Mask<F> is_delta_only(const Bsdf<F>& b) { return b.delta_only; }

template <class F> Vec<F> flip_z(const Mask<F>& m, const Vec<F>& w) { return {w.x, w.y, select(m, -w.z, w.z)}; }
// wo on the upper side, and never so grazing that a half vector vanishes.
template <class F> Vec<F> upper_wo(const Bsdf<F>& b, const Vec<F>& wo) {
    return {wo.x, wo.y, max(select(b.flipped, -wo.z, wo.z), F(grazing))};
}

// ---- eval

// The normal of the facet that scatters wo to wi, both in the viewer's frame, and the Jacobian |dh / dwi| times dot(wo, h).
template <class F> struct Facet {
    Vec<F> h;
    F cos;      // dot(wo, h)
    F jacobian; // times cos
    Mask<F> faces_both;
};
template <Features S, class F> Facet<F> facet_between(const Bsdf<F>& b, const Vec<F>& wo, const Vec<F>& wi) {
    Vec<F> sum = wo + wi;
    Mask<F> through = Mask<F>(false);
    if constexpr (S.has(Feature::transmission)) {
        const Mask<F> below = wi.z < F(0.f);
        through = below && b.solid;
        // wo + eta wi, so written that nothing is lost where eta is almost 1; it points to the denser side.
        const F excess = b.interface.eta_squared_minus_1 / (b.interface.eta + 1.f);
        const Vec<F> bent = sum + wi * excess;
        sum = select(through, bent * select(bent.z < F(0.f), F(-1.f), F(1.f)), wo + flip_z(below, wi));
    }
    Facet<F> f;
    f.h = sum / sqrt(max(length_squared(sum), F(1e-30f)));
    f.cos = max(dot(wo, f.h), F(grazing));
    f.jacobian = F(0.25f);
    f.faces_both = dot(wo, f.h) > F(0.f);
    if constexpr (S.has(Feature::transmission)) {
        // Walter et al. 2007, equation 17, numerator and denominator divided by eta^2.
        const F cos_i = dot(wi, f.h);
        const F d = cos_i + f.cos / b.interface.eta;
        const F refracted = abs(cos_i) * f.cos / max(F(d * d), F(1e-30f));
        f.jacobian = select(through, refracted, f.jacobian);
        f.faces_both = f.faces_both && (!through || cos_i < F(0.f));
    }
    return f;
}

template <Features S, class F> BsdfValue<F> eval(const Bsdf<F>& b, const Vec<F>& wo_surface, const Vec<F>& wi_surface) {
    if constexpr (!has_facets(S)) {
        const F pdf = cosine_hemisphere_pdf(wi_surface.z);
        return {b.diffuse * pdf, pdf};
    } else {
        const Vec<F> wo = upper_wo(b, wo_surface), wi = flip_z(b.flipped, wi_surface);
        const Mask<F> above = wi.z > F(0.f);
        const Facet<F> facet = facet_between<S>(b, wo, wi);
        const FacetAlbedo<F> albedo = facet_albedo<S>(b, facet.cos);
        const F cosine = cosine_hemisphere_pdf(wi.z);
        const Vec<F> diffuse = b.diffuse * (1.f - select(above, albedo.layer, F(0.f))) * cosine;

        const Mask<F> dense = facet.faces_both && select(above, !b.smooth, !(b.smooth || b.straight)) && abs(wi.z) > F(0.f);
        const F density = select(dense, ggx(b.alpha, facet.h) * b.visible * facet.jacobian, F(0.f));
        const Vec<F> scattered = select(above, albedo.reflected, albedo.transmitted * b.radiance_scale);
        const F pdf = facet_probability<S>(albedo, above) * density;
        return {diffuse + scattered * (density * masking(b.alpha, wi)), b.p_diffuse * cosine + (1.f - b.p_diffuse) * pdf};
    }
}

// ---- sample

// A direction for the facets alone, in the viewer's frame; u, v choose the facet, `choice` what it does.
template <Features S, class F> BsdfSample<F> sample_facets(const Bsdf<F>& b, const Vec<F>& wo, const F& u, const F& v, const F& choice) {
    const Vec<F> z{F(0.f), F(0.f), F(1.f)};
    Vec<F> h = select(b.smooth, z, sample_visible_normal(b.alpha, wo, u, v));
    F cos = max(dot(wo, h), F(grazing));
    const FacetAlbedo<F> a = facet_albedo<S>(b, cos);
    const Mask<F> reflects = choice < facet_probability<S>(a, Mask<F>(true));
    BsdfSample<F> s;
    s.wi = h * (2.f * cos) - wo;
    s.weight = a.reflected;
    s.pdf = F(1.f);
    s.delta = b.smooth;
    s.valid = s.wi.z > F(0.f);
    if constexpr (S.has(Feature::transmission)) {
        h = select(b.straight, z, h);
        cos = select(b.straight, b.cos, cos);
        const Vec<F> through = select(b.solid, refract(b.interface, wo, h, cos), flip_z(Mask<F>(true), s.wi));
        s.wi = select(reflects, s.wi, through);
        s.weight = select(reflects, s.weight, a.transmitted * b.radiance_scale);
        s.delta = s.delta || (b.straight && !reflects);
        s.valid = select(reflects, s.valid, s.wi.z < F(0.f));
    }
    s.weight = s.weight / facet_probability<S>(a, reflects);
    return s;
}

// u, v, choice: uniform in [0, 1), independent.
template <Features S, class F> BsdfSample<F> sample(const Bsdf<F>& b, const Vec<F>& wo_surface, const F& u, const F& v, const F& choice) {
    BsdfSample<F> s;
    s.wi = sample_cosine_hemisphere(u, v);
    s.delta = Mask<F>(false);
    if constexpr (!has_facets(S)) {
        s.weight = b.diffuse;
        s.pdf = cosine_hemisphere_pdf(s.wi.z);
        s.valid = s.pdf > F(0.f);
    } else {
        const Mask<F> is_diffuse = choice < b.p_diffuse;
        s.valid = s.wi.z > F(0.f);
        s.weight = splat<F>(0.f);
        const F p_facets = 1.f - b.p_diffuse;
        if (!all(is_diffuse)) {
            const F rest = min(F((choice - b.p_diffuse) / max(p_facets, F(1e-20f))), F(one_minus_epsilon));
            const BsdfSample<F> facet = sample_facets<S>(b, upper_wo(b, wo_surface), u, v, rest);
            s.wi = select(is_diffuse, s.wi, facet.wi);
            s.delta = !is_diffuse && facet.delta;
            s.weight = facet.weight / max(p_facets, F(1e-20f));
            s.valid = select(is_diffuse, s.valid, facet.valid);
        }
        s.wi = flip_z(b.flipped, s.wi);
        const BsdfValue<F> value = eval<S>(b, wo_surface, s.wi);
        s.pdf = select(s.delta, F(1.f), value.pdf);
        s.valid = s.valid && s.pdf > F(0.f);
        const Vec<F> mixed = value.f_cos / select(s.valid, s.pdf, F(1.f));
        // Of a Lambertian surface the quotient is its albedo, exactly.
        s.weight = select(s.delta, s.weight, select(b.p_diffuse == F(1.f), b.diffuse, mixed));
        s.weight = select(s.valid, s.weight, splat<F>(0.f));
    }
    return s;
}

// Roughly how much of a uniform light comes back or through, in [0, 1]: the denoiser's guide.
template <Features S, class F> Vec<F> albedo(const Bsdf<F>& b, const Vec<F>&) {
    if constexpr (has_facets(S)) {
        const FacetAlbedo<F> a = facet_albedo<S>(b, b.cos);
        const Vec<F> sum = b.diffuse * (1.f - a.layer) + a.reflected + a.transmitted;
        return {clamp01(sum.x), clamp01(sum.y), clamp01(sum.z)};
    } else {
        return b.diffuse;
    }
}

} // namespace blush::inline BLUSH_ISA
