// The base of a material, below its layers: glTF 2.0 Appendix B with KHR_materials_ior, _specular, _transmission, _volume,
// _anisotropy, _iridescence and _diffuse_transmission. It has two parts: a Lambertian one, and GGX microfacets, each of which
// reflects or transmits.
//
// Features outside of S are not computed, and features that a material does not use do not change the result by a bit: their
// factors are exactly 1, their summands exactly 0.
#pragma once

#include "shading/bsdf_types.h"
#include "shading/energy.h"
#include "shading/thin_film.h"

namespace blush::inline BLUSH_ISA {

// Roughness of the microfacets: one alpha, or one each for x and y.
template <Features S, class F> auto alpha_of(const Bsdf<F>& b) {
    if constexpr (S.has(Feature::anisotropy))
        return b.stretch;
    else
        return b.alpha;
}

// ---- microfacets: reflectance and transmittance of one with cosine c = dot(wo, h) > 0

template <class F> struct FacetAlbedo {
    F layer;            // largest component of the dielectric's reflectance: the share that its base does not get
    Vec<F> reflected;   // into the mirror direction
    Vec<F> transmitted; // through the surface
};

// Cosine on the air side of a solid, where a thin film is: c itself, or that of the ray refracted to c.
template <Features S, class F> F cosine_in_air(const Bsdf<F>& b, const F& c) {
    if constexpr (!S.has(Feature::transmission)) return c;
    return select(b.flipped, F(refracted_g(b.interface, c) / b.interface.eta), c);
}

// Appendix B uses Schlick's approximation, and so does this code, except for solids: they need correct total internal reflection,
// and the same split ratio from both sides. For them the exact Fresnel curve replaces Schlick's between f0 and 1 (Appendix B's
// non-normative section on implementation allows this), so that specular and specular_color mean the same.
template <Features S, class F> FacetAlbedo<F> facet_albedo(const Bsdf<F>& b, const F& c) {
    const F rise = schlick(c);
    F dielectric_rise = rise;
    Mask<F> total = Mask<F>(false);
    if constexpr (S.has(Feature::transmission)) {
        // Straight transmission does not involve microfacets: the surface normal decides how much is reflected.
        const F at = select(b.straight, b.cos, c);
        const F exact = clamp01(F((dielectric_reflectance(b.interface, at) - b.interface_f0) / max(F(1.f - b.interface_f0), F(1e-6f))));
        dielectric_rise = select(b.solid, exact, rise);
        total = b.solid && (b.mirror || totally_reflects(b.interface, at));
    }
    const Vec<F> one = splat<F>(1.f);
    Vec<F> fresnel = (b.f0 + (one - b.f0) * dielectric_rise) * b.specular;
    Vec<F> metal = b.metal_color + (one - b.metal_color) * rise;
    if constexpr (S.has(Feature::iridescence)) {
        if (any(b.iridescence > F(0.f))) {
            const ThinFilm<F> film = make_thin_film(b.film_ior, b.film_thickness, cosine_in_air<S>(b, c));
            fresnel = lerp(fresnel, thin_film_reflectance(film, b.f0) * b.specular, b.iridescence);
            metal = lerp(metal, thin_film_reflectance(film, b.metal_color), b.iridescence);
        }
    }
    fresnel = select(total, one, fresnel);
    const F layer = max_component(fresnel);
    FacetAlbedo<F> a{layer, fresnel * b.dielectric_gain + metal * b.metal_gain, splat<F>(0.f)};
    if constexpr (S.has(Feature::transmission)) a.transmitted = b.transmitted * (1.f - layer);
    return a;
}

// Probability that a sampled microfacet reflects rather than transmits.
template <Features S, class F> F facet_probability(const FacetAlbedo<F>& a, const Mask<F>& reflects) {
    const F certain = select(reflects, F(1.f), F(0.f));
    if constexpr (!S.has(Feature::transmission)) return certain;
    const F r = max_component(a.reflected), t = max_component(a.transmitted);
    return select(t > F(0.f), select(reflects, r, t) / (r + t), certain);
}

// ---- make

// True if light travels inside.
template <Features S, class F> Mask<F> is_solid(const BsdfParams<F>& m) {
    if constexpr (!S.has(Feature::transmission))
        return Mask<F>(false);
    else if constexpr (!S.has(Feature::diffuse_transmission))
        return m.transmission > F(0.f) && !m.thin;
    else
        return (m.transmission > F(0.f) || m.layers.diffuse_transmission > F(0.f)) && !m.thin;
}

// Index of refraction of the interface between the material and air; 1 (no interface) if there is no reflection: a translucent
// material without microfacets.
template <Features S, class F> F interface_ior(const BsdfParams<F>& m) {
    const F ior = max(m.ior, F(1.f));
    if constexpr (!S.has(Feature::diffuse_transmission))
        return ior;
    else
        return select(m.specular > F(0.f) || m.transmission > F(0.f), ior, F(1.f));
}

template <Features S, class F> void make_facets(Bsdf<F>& b, const BsdfParams<F>& m, const Vec<F>& wo, const EnergyTable* energy) {
    const Vec<F> one = splat<F>(1.f);
    b.cos = max(abs(wo.z), F(grazing));
    b.solid = is_solid<S>(m);
    b.flipped = b.solid && wo.z < F(0.f);
    b.smooth = m.roughness < F(smooth_roughness);
    b.alpha = max(F(m.roughness * m.roughness), F(smooth_roughness * smooth_roughness));
    if constexpr (S.has(Feature::anisotropy)) {
        const F strength = m.layers.anisotropy;
        b.stretch = make_stretch(F(b.alpha + (1.f - b.alpha) * (strength * strength)), b.alpha);
        b.smooth = b.smooth && !(strength > F(0.f));
    }
    if constexpr (S.has(Feature::iridescence)) {
        b.iridescence = m.layers.iridescence;
        b.film_ior = m.layers.film_ior;
        b.film_thickness = m.layers.film_thickness;
    }
    b.visible = masking_over_cos(alpha_of<S>(b), Vec<F>{wo.x, wo.y, b.cos});

    b.metal_color = m.base_color;
    b.specular = m.specular;
    const Vec<F> f0 = m.specular_color * normal_reflectance(m.ior);
    b.f0 = {min(f0.x, F(1.f)), min(f0.y, F(1.f)), min(f0.z, F(1.f))};
    b.metal_gain = one * m.metallic;
    b.dielectric_gain = one * (1.f - m.metallic);
    if constexpr (S.has(Feature::energy_compensation)) {
        if (energy) {
            F roughness = m.roughness;
            // Approximation: anisotropic microfacets lose about as much energy as isotropic ones of the same alpha product.
            if constexpr (S.has(Feature::anisotropy))
                roughness = select(m.layers.anisotropy > F(0.f), sqrt(sqrt(b.stretch.product)), roughness);
            const F lost = select(b.smooth, F(0.f), 1.f / directional_albedo(*energy, roughness, b.cos) - 1.f);
            b.metal_gain = b.metal_gain * (one + b.metal_color * lost);
            b.dielectric_gain = b.dielectric_gain * (one + b.f0 * (b.specular * lost));
        }
    }

    b.radiance_scale = F(1.f);
    b.straight = Mask<F>(false);
    if constexpr (S.has(Feature::transmission)) {
        const F ior = interface_ior<S>(m);
        b.transmitted = m.base_color * ((1.f - m.metallic) * m.transmission);
        b.interface = interface_seen(b.flipped, ior);
        b.interface_f0 = normal_reflectance(ior);
        // Refraction compresses radiance into the smaller solid angle of the denser side: it keeps L / eta^2 (Veach 1997, section
        // 5.2). A path that leaves again has both factors, and a glass ball in a furnace is as bright as the furnace.
        b.radiance_scale = select(b.solid, 1.f / (b.interface.eta * b.interface.eta), F(1.f));
        b.mirror = m.ior < F(1.f);
        if constexpr (S.has(Feature::diffuse_transmission)) b.mirror = b.mirror && (m.specular > F(0.f) || m.transmission > F(0.f));
        b.straight = b.solid && (b.smooth || alpha_along_x(alpha_of<S>(b)) * (ior - 1.f) < F(1e-5f));
    }
}

// Splits the Lambertian part into reflection and diffuse transmission. Into a solid the light spreads by Lambert's law on the
// other side, and since only 1 / ior^2 of such light can leave again, the rest is reflected inside: in equilibrium the radiance
// inside is ior^2 times that outside, as for clear glass.
template <Features S, class F> void make_through(Bsdf<F>& b, const BsdfParams<F>& m) {
    const F share = m.layers.diffuse_transmission;
    const Vec<F> through = m.layers.diffuse_transmission_color * ((1.f - m.metallic) * (1.f - m.transmission) * share);
    const F ior = interface_ior<S>(m), leaves = select(b.solid, 1.f / (ior * ior), F(1.f));
    b.diffuse = b.diffuse * (1.f - share) + through * select(b.flipped, 1.f - leaves, F(0.f));
    b.through = through * select(b.flipped, F(1.f), leaves);
    const F down = max_component(b.through), up = max_component(b.diffuse);
    b.p_through = down / max(down + up, F(1e-20f));
}

// Sets the microfacets' share of samples in proportion to what the parts reflect towards wo. On a rough surface the visible
// microfacets are less grazing than the surface, hence the cosine; the bounds limit the weights where the estimate is inaccurate.
// Returns the approximate total albedo of both parts.
template <Features S, class F> F choose_probabilities(Bsdf<F>& b, const BsdfParams<F>& m) {
    const FacetAlbedo<F> a = facet_albedo<S>(b, F(b.cos + (1.f - b.cos) * (0.5f * b.alpha)));
    F diffuse_albedo = max_component(b.diffuse);
    if constexpr (S.has(Feature::diffuse_transmission)) diffuse_albedo = diffuse_albedo + max_component(b.through);
    const F diffuse = diffuse_albedo * (1.f - a.layer);
    const F facets = max(max_component(a.reflected), max_component(a.transmitted));
    const F p = min(max(diffuse / max(diffuse + facets, F(1e-20f)), F(0.1f)), F(0.9f));
    // Uses the parameters: a microfacet that reflects nothing at one angle may reflect at another.
    const Mask<F> no_diffuse = !(diffuse_albedo > F(0.f));
    const Mask<F> no_facets = !(m.metallic > F(0.f) || m.specular > F(0.f) || m.transmission > F(0.f));
    b.p_diffuse = select(no_facets, F(1.f), select(no_diffuse, F(0.f), p));
    b.delta_only = no_diffuse && (no_facets || b.smooth);
    return diffuse + facets;
}

// Returns the approximate albedo of the base. `energy`: compensates the energy loss of the microfacet model; null (or S without
// energy_compensation): no compensation.
template <Features S, class F> F make_base(Bsdf<F>& b, const BsdfParams<F>& m, const Vec<F>& wo, const EnergyTable* energy) {
    if constexpr (has_facets(S)) {
        b.diffuse = m.base_color * ((1.f - m.metallic) * (1.f - m.transmission));
        make_facets<S>(b, m, wo, energy);
        if constexpr (S.has(Feature::diffuse_transmission)) make_through<S>(b, m);
        return choose_probabilities<S>(b, m);
    } else {
        b.diffuse = m.base_color;
        b.delta_only = !(max_component(b.diffuse) > F(0.f));
        return max_component(b.diffuse);
    }
}

// ---- eval

// The normal of the microfacet that scatters wo to wi, both in the viewer's frame, and the Jacobian |dh / dwi| times dot(wo, h).
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
        // wo + eta wi, written to avoid cancellation for eta near 1; it points to the denser side.
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

template <Features S, class F> BsdfValue<F> eval_base(const Bsdf<F>& b, const Vec<F>& wo_surface, const Vec<F>& wi_surface) {
    if constexpr (!has_facets(S)) {
        const F pdf = cosine_hemisphere_pdf(wi_surface.z);
        return {b.diffuse * pdf, pdf};
    } else {
        const Vec<F> wo = upper_wo(b, wo_surface), wi = flip_z(b.flipped, wi_surface);
        const Mask<F> above = wi.z > F(0.f);
        const Facet<F> facet = facet_between<S>(b, wo, wi);
        const FacetAlbedo<F> albedo = facet_albedo<S>(b, facet.cos);
        F cosine = cosine_hemisphere_pdf(wi.z);
        Vec<F> diffuse = b.diffuse * (1.f - select(above, albedo.layer, F(0.f))) * cosine;
        if constexpr (S.has(Feature::diffuse_transmission)) {
            const F below = cosine_hemisphere_pdf(F(-wi.z));
            const Mask<F> crosses = below * b.p_through > F(0.f);
            if (any(crosses)) {
                // Reflected light is not transmitted: uses the Fresnel term of
                // the microfacet that would mirror the light, as for thin walls.
                const F c = sqrt(max(F(0.5f + 0.5f * dot(wo, flip_z(Mask<F>(true), wi))), F(0.f)));
                const F reflected = facet_albedo<S>(b, max(c, F(grazing))).layer;
                diffuse = diffuse + b.through * select(crosses, (1.f - reflected) * below, F(0.f));
            }
            cosine = cosine * (1.f - b.p_through) + below * b.p_through;
        }

        const Mask<F> dense = facet.faces_both && select(above, !b.smooth, !(b.smooth || b.straight)) && abs(wi.z) > F(0.f);
        const F density = select(dense, ggx(alpha_of<S>(b), facet.h) * b.visible * facet.jacobian, F(0.f));
        const Vec<F> scattered = select(above, albedo.reflected, albedo.transmitted * b.radiance_scale);
        const F pdf = facet_probability<S>(albedo, above) * density;
        return {diffuse + scattered * (density * masking(alpha_of<S>(b), wi)), b.p_diffuse * cosine + (1.f - b.p_diffuse) * pdf};
    }
}

// ---- sample

// Samples a direction from the microfacets alone, in the viewer's frame;
// u, v choose the microfacet, `choice` reflection or transmission.
template <Features S, class F> BsdfSample<F> sample_facets(const Bsdf<F>& b, const Vec<F>& wo, const F& u, const F& v, const F& choice) {
    const Vec<F> z{F(0.f), F(0.f), F(1.f)};
    Vec<F> h = select(b.smooth, z, sample_visible_normal(alpha_of<S>(b), wo, u, v));
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
        // By rounding, a microfacet at the edge of visibility may face away
        // from the viewer: its refracted direction is not of unit length.
        s.valid = select(reflects, s.valid, s.wi.z < F(0.f) && dot(wo, h) > F(0.f));
    }
    s.weight = s.weight / facet_probability<S>(a, reflects);
    return s;
}

// Samples a direction of the base; sets the weight only for a delta
// lobe, and no pdf. u, v, choice: uniform in [0, 1), independent.
template <Features S, class F>
BsdfSample<F> draw_base(const Bsdf<F>& b, const Vec<F>& wo_surface, const F& u, const F& v, const F& choice) {
    BsdfSample<F> s;
    s.wi = sample_cosine_hemisphere(u, v);
    s.weight = splat<F>(0.f);
    s.delta = Mask<F>(false);
    s.valid = s.wi.z > F(0.f);
    if constexpr (has_facets(S)) {
        const Mask<F> is_diffuse = choice < b.p_diffuse;
        const F p_facets = 1.f - b.p_diffuse;
        if (!all(is_diffuse)) {
            const F rest = min(F((choice - b.p_diffuse) / max(p_facets, F(1e-20f))), F(one_minus_epsilon));
            const BsdfSample<F> facet = sample_facets<S>(b, upper_wo(b, wo_surface), u, v, rest);
            s.wi = select(is_diffuse, s.wi, facet.wi);
            s.delta = !is_diffuse && facet.delta;
            s.weight = facet.weight / max(p_facets, F(1e-20f));
            s.valid = select(is_diffuse, s.valid, facet.valid);
        }
        if constexpr (S.has(Feature::diffuse_transmission)) { s.wi = flip_z(choice < b.p_diffuse * b.p_through, s.wi); }
        s.wi = flip_z(b.flipped, s.wi);
    }
    return s;
}

// Approximate albedo (reflected and transmitted) under uniform light.
template <Features S, class F> Vec<F> albedo_of_base(const Bsdf<F>& b) {
    if constexpr (has_facets(S)) {
        const FacetAlbedo<F> a = facet_albedo<S>(b, b.cos);
        Vec<F> diffuse = b.diffuse;
        if constexpr (S.has(Feature::diffuse_transmission)) diffuse = diffuse + b.through;
        return diffuse * (1.f - a.layer) + a.reflected + a.transmitted;
    } else {
        return b.diffuse;
    }
}

} // namespace blush::inline BLUSH_ISA
