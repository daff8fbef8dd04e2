// The BSDF of a surface point (make_bsdf, then eval / sample): the base (base.h) and, if S has them, the layers on top of it. A
// layer scales the parts below it by 1 minus its own maximal reflectance.
//
// Features outside of S are not computed, and features that a material does not use do not change the result by a bit: their
// factors are exactly 1, their summands exactly 0.
#pragma once

#include "shading/base.h"
#include "shading/clearcoat.h"
#include "shading/sheen.h"

namespace blush::inline BLUSH_ISA {

// Probability of sampling a layer with reflectance `layer` and not the parts below it, which have reflectance `below`. It is in
// proportion to their albedos towards the viewer, as between the parts of the base.
template <class F> F layer_probability(const F& layer, const F& below) {
    const F p = min(max(F(layer / max(layer + below, F(1e-20f))), F(0.1f)), F(0.9f));
    return select(layer > F(0.f), p, F(0.f));
}

// Sheen on the base, and a clear coat on both. A layer that S lacks has strength 0.
template <Features S, class F>
void make_layers(Bsdf<F>& b, const LayerParams<F>& m, const Vec<F>& wo, const EnergyTable* energy, F base_albedo) {
    b.p_base = F(1.f);
    if constexpr (S.has(Feature::sheen)) {
        b.sheen = make_sheen(m, upper_wo(b, wo));
        const F layer = b.sheen.strength * min(b.sheen.albedo, F(1.f)), below = base_albedo * left_below_sheen(b.sheen);
        b.sheen.probability = select(b.sheen.strength > F(0.f), layer_probability(max(layer, F(1e-10f)), below), F(0.f));
        b.p_base = 1.f - b.sheen.probability;
        base_albedo = layer + below;
        b.delta_only = b.delta_only && !(b.sheen.strength > F(0.f));
    }
    if constexpr (S.has(Feature::clearcoat)) {
        b.coat = make_clearcoat<S>(b, m, wo, energy);
        b.coat.probability = layer_probability(b.coat.reflected, F(base_albedo * b.coat.left));
        b.p_base = b.p_base * (1.f - b.coat.probability);
        if constexpr (S.has(Feature::sheen)) b.sheen.probability = b.sheen.probability * (1.f - b.coat.probability);
        b.delta_only = b.delta_only && (b.coat.smooth || !(b.coat.reflected > F(0.f)));
    }
}

// `energy`: compensates the energy loss of the microfacet model; null (or S without energy_compensation): no compensation.
template <Features S, class F> Bsdf<F> make_bsdf(const BsdfParams<F>& m, const Vec<F>& wo, const EnergyTable* energy) {
    // Members that kernels with S do not read stay uninitialized: setting them to zero would cost 6 % of shading.
    Bsdf<F> b;
    if constexpr (!has_facets(S)) {
        b.p_diffuse = F(1.f);
        b.solid = b.flipped = Mask<F>(false);
    }
    const F base_albedo = make_base<S>(b, m, wo, energy);
    if constexpr (has_layers(S)) make_layers<S>(b, m.layers, wo, energy, base_albedo);
    return b;
}

// True if there are only delta lobes: eval is 0 for every direction, and NEE would be wasted.
template <class F> Mask<F> is_delta_only(const Bsdf<F>& b) { return b.delta_only; }
// True if the BSDF is Lambertian: radiance is the same for all viewers, with reflectance b.diffuse.
template <Features S, class F> Mask<F> is_lambertian(const Bsdf<F>& b) {
    Mask<F> lambertian = Mask<F>(true);
    if constexpr (has_facets(S)) lambertian = b.p_diffuse == F(1.f);
    if constexpr (S.has(Feature::diffuse_transmission)) lambertian = lambertian && !(b.p_through > F(0.f));
    if constexpr (has_layers(S)) lambertian = lambertian && b.p_base == F(1.f);
    return lambertian;
}
// True if the BSDF scatters with a density, and only to the side of the viewer.
template <Features S, class F> Mask<F> only_reflects(const Bsdf<F>& b, const BsdfParams<F>& m) {
    Mask<F> reflects = !is_delta_only<F>(b);
    if constexpr (S.has(Feature::transmission)) reflects = reflects && !(m.transmission > F(0.f));
    if constexpr (S.has(Feature::diffuse_transmission)) reflects = reflects && !(m.layers.diffuse_transmission > F(0.f));
    return reflects;
}

// Share of the base's light that the layers let through between viewer and wi, both in the viewer's frame.
template <Features S, class F> F left_for_base(const Bsdf<F>& b, const Vec<F>& wi) {
    F left = F(1.f);
    if constexpr (S.has(Feature::sheen)) left = left_below_sheen(b.sheen, wi);
    if constexpr (S.has(Feature::clearcoat)) left = left * b.coat.left;
    return left;
}

template <Features S, class F> BsdfValue<F> eval(const Bsdf<F>& b, const Vec<F>& wo_surface, const Vec<F>& wi_surface) {
    BsdfValue<F> value = eval_base<S>(b, wo_surface, wi_surface);
    if constexpr (has_layers(S)) {
        const Vec<F> wi = flip_z(b.flipped, wi_surface);
        value.f_cos = value.f_cos * left_for_base<S>(b, wi);
        value.pdf = b.p_base * value.pdf;
        if constexpr (S.has(Feature::sheen)) {
            const BsdfValue<F> sheen = eval_sheen(b.sheen, upper_wo(b, wo_surface), wi);
            F left = F(1.f);
            if constexpr (S.has(Feature::clearcoat)) left = b.coat.left;
            value.f_cos = value.f_cos + sheen.f_cos * left;
            value.pdf = value.pdf + b.sheen.probability * sheen.pdf;
        }
        if constexpr (S.has(Feature::clearcoat)) {
            const BsdfValue<F> coat = eval_clearcoat(b.coat, wi);
            value.f_cos = value.f_cos + coat.f_cos;
            value.pdf = value.pdf + b.coat.probability * coat.pdf;
        }
    }
    return value;
}

// Share of the density `pdf` of eval() that lobes other than the Lambertian ones and sheen have; 0 on a Lambertian surface.
template <Features S, class F> F facet_share(const Bsdf<F>& b, const Vec<F>& wi_surface, const F& pdf) {
    const Vec<F> wi = flip_z(b.flipped, wi_surface);
    F wide = cosine_hemisphere_pdf(wi.z);
    if constexpr (S.has(Feature::diffuse_transmission)) wide = wide * (1.f - b.p_through) + cosine_hemisphere_pdf(F(-wi.z)) * b.p_through;
    wide = wide * b.p_diffuse;
    if constexpr (has_layers(S)) wide = wide * b.p_base;
    if constexpr (S.has(Feature::sheen)) wide = wide + select(wi.z > F(0.f), b.sheen.probability * (0.5f * inv_pi), F(0.f));
    return clamp01(F(1.f - wide / max(pdf, F(1e-30f))));
}

// As draw_base; choice first selects the layer: coat, then sheen, then base.
template <Features S, class F> BsdfSample<F> draw(const Bsdf<F>& b, const Vec<F>& wo, const F& u, const F& v, const F& choice) {
    if constexpr (!has_layers(S)) return draw_base<S>(b, wo, u, v, choice);
    F p_layers = F(0.f);
    if constexpr (S.has(Feature::clearcoat)) p_layers = b.coat.probability;
    if constexpr (S.has(Feature::sheen)) p_layers = p_layers + b.sheen.probability;
    const F rest = min(F((choice - p_layers) / max(b.p_base, F(1e-20f))), F(one_minus_epsilon));
    BsdfSample<F> s = draw_base<S>(b, wo, u, v, max(rest, F(0.f)));
    s.weight = s.weight * (left_for_base<S>(b, flip_z(b.flipped, s.wi)) / b.p_base);
    const Mask<F> in_layer = choice < p_layers;
    if constexpr (S.has(Feature::sheen)) {
        s.wi = select(in_layer, flip_z(b.flipped, sample_cone(F(1.f), u, v)), s.wi);
        s.delta = s.delta && !in_layer;
        s.valid = s.valid || in_layer;
    }
    if constexpr (S.has(Feature::clearcoat)) {
        const Mask<F> in_coat = choice < b.coat.probability;
        if (any(in_coat)) {
            const BsdfSample<F> coat = draw_clearcoat(b.coat, u, v);
            s.wi = select(in_coat, flip_z(b.flipped, coat.wi), s.wi);
            s.weight = select(in_coat, coat.weight / max(b.coat.probability, F(1e-20f)), s.weight);
            s.delta = select(in_coat, coat.delta, s.delta);
            s.valid = select(in_coat, coat.valid, s.valid);
        }
    }
    return s;
}

// u, v, choice: uniform in [0, 1), independent.
template <Features S, class F> BsdfSample<F> sample(const Bsdf<F>& b, const Vec<F>& wo, const F& u, const F& v, const F& choice) {
    BsdfSample<F> s = draw<S>(b, wo, u, v, choice);
    if constexpr (!has_facets(S) && !has_layers(S)) {
        s.weight = b.diffuse;
        s.pdf = cosine_hemisphere_pdf(s.wi.z);
        s.valid = s.pdf > F(0.f);
    } else {
        const BsdfValue<F> value = eval<S>(b, wo, s.wi);
        s.pdf = select(s.delta, F(1.f), value.pdf);
        s.valid = s.valid && s.pdf > F(0.f);
        const Vec<F> mixed = value.f_cos / select(s.valid, s.pdf, F(1.f));
        // On a Lambertian surface the quotient is exactly its albedo.
        s.weight = select(s.delta, s.weight, select(is_lambertian<S>(b), b.diffuse, mixed));
        s.weight = select(s.valid, s.weight, splat<F>(0.f));
    }
    return s;
}

// The delta lobe that continues straight, to -wo: for thin, smooth, transmissive walls. 0 for all other surfaces.
template <class F> struct StraightTransmission {
    Vec<F> value;  // transmittance
    F probability; // probability that sample() chooses it; it is the last lobe, for choice >= 1 - probability
};
template <Features S, class F> StraightTransmission<F> straight_transmission(const Bsdf<F>& b, const Vec<F>& wo) {
    if constexpr (!S.has(Feature::transmission))
        return {splat<F>(0.f), F(0.f)};
    else {
        const FacetAlbedo<F> a = facet_albedo<S>(b, b.cos);
        const Mask<F> passes = b.smooth && !b.solid && max_component(a.transmitted) > F(0.f);
        F probability = (1.f - b.p_diffuse) * facet_probability<S>(a, Mask<F>(false));
        Vec<F> value = a.transmitted;
        if constexpr (has_layers(S)) {
            probability = probability * b.p_base;
            value = value * left_for_base<S>(b, -wo);
        }
        return {select<F>(passes, value, splat<F>(0.f)), select(passes, probability, F(0.f))};
    }
}

// Approximate albedo (reflected and transmitted) under uniform light, in [0, 1]: for the denoiser.
template <Features S, class F> Vec<F> albedo(const Bsdf<F>& b, const Vec<F>&) {
    Vec<F> sum = albedo_of_base<S>(b);
    if constexpr (S.has(Feature::sheen)) sum = sum * left_below_sheen(b.sheen) + b.sheen.color * min(b.sheen.albedo, F(1.f));
    if constexpr (S.has(Feature::clearcoat)) sum = sum * b.coat.left + splat<F>(1.f) * b.coat.reflected;
    if constexpr (has_facets(S) || has_layers(S)) sum = clamp01(sum);
    return sum;
}

} // namespace blush::inline BLUSH_ISA
