// Inputs and results of the BSDF: the records shared by the base, the layers and bsdf.h.
//
// Local frame: z is the shading normal; directions are unit and point away from the surface. wo.z > 0 unless the surface bounds a
// solid (transmission, not thin): then z points out of it, and wo.z < 0 is a viewer inside.
#pragma once

#include "core/sampling.h"
#include "shading/features.h"
#include "shading/fresnel.h"
#include "shading/microfacet.h"

namespace blush::inline BLUSH_ISA {

// KHR_materials_* parameters beyond the metallic-roughness material. All 0: no layers.
template <class F> struct LayerParams {
    F clearcoat; // share of the surface that is coated
    F clearcoat_roughness;
    Vec<F> clearcoat_normal; // unit, local frame; z if no viewer can be in front of it
    Vec<F> sheen_color;
    F sheen_roughness;
    F anisotropy;               // increases the base's roughness along the local x
    F iridescence;              // share of the base under a thin film
    F film_ior, film_thickness; // nanometres
    F diffuse_transmission;     // transmitted share of the diffuse part
    Vec<F> diffuse_transmission_color;
};

// Scattering at a surface point, textures already applied. Colours are linear Rec.709.
template <class F> struct BsdfParams {
    Vec<F> base_color; // albedo of the diffuse or metallic part, tint of the transmitted part
    F metallic;
    F roughness; // perceptual: alpha is its square
    F ior;       // relative to vacuum, >= 1; or 0, which reflects like a mirror (KHR_materials_ior)
    F specular;  // KHR_materials_specular; 0: no dielectric reflection
    Vec<F> specular_color;
    F transmission; // KHR_materials_transmission
    Mask<F> thin;   // transmits without refraction, has no inside
    LayerParams<F> layers{};
};

// Delta lobes are covered by sample() only.
template <class F> struct BsdfValue {
    Vec<F> f_cos; // f |wi.z|, 1/sr
    F pdf;        // of sample(), per solid angle
};

template <class F> struct BsdfSample {
    Vec<F> wi;
    Vec<F> weight; // f |wi.z| / pdf over all non-delta lobes; for a delta lobe its reflectance over its probability
    F pdf;         // as in eval; 1 for a delta lobe
    Mask<F> delta;
    Mask<F> valid; // false: no direction was sampled, weight 0
};

// Clear coat prepared for one viewer: clearcoat.h.
template <class F> struct Clearcoat {
    Basis<F> frame; // around the coat's normal, in the viewer's frame
    Vec<F> wo;      // in `frame`
    F reflected;    // reflected share of the light
    F left;         // share for the layers below
    F alpha, visible;
    Mask<F> smooth;
    F probability; // of sampling it
};

// Sheen prepared for one viewer: sheen.h.
template <class F> struct Sheen {
    Vec<F> color;
    F strength; // largest component of its colour
    F roughness, alpha;
    F albedo;      // directional albedo of white sheen for wo, from the table
    F probability; // of sampling it
};

// BSDF prepared by make_bsdf for a point and a viewer.
template <class F> struct Bsdf {
    Vec<F> diffuse;     // albedo of the Lambertian part below the Fresnel reflection
    Mask<F> delta_only; // no lobe has a density
    // Only with microfacets:
    Vec<F> metal_color, metal_gain; // reflects metal_gain * Schlick(metal_color)
    Vec<F> f0, dielectric_gain;     // ... + dielectric_gain * specular * Fresnel(f0)
    Vec<F> transmitted;             // tint of the light that the dielectric does not reflect
    F specular, alpha;
    F cos;                  // |wo.z|
    F visible;              // masking(wo) / |wo.z|
    Interface<F> interface; // for solids
    F interface_f0;         // its reflectance at normal incidence
    F radiance_scale;       // of transmitted light
    F p_diffuse;            // probability of sampling the Lambertian part
    Mask<F> solid, flipped; // flipped: the viewer is below z = 0
    Mask<F> mirror;         // ior 0: no light enters a solid
    Mask<F> smooth;         // all microfacets face z: reflection and thin transmission are delta lobes
    Mask<F> straight;       // refraction is below single precision: transmission is a delta lobe
    // Only with the respective features:
    Stretch<F> stretch;                      // anisotropic alpha
    F iridescence, film_ior, film_thickness; // thin film on the microfacets
    Vec<F> through;                          // albedo of the Lambertian part of the other side, as diffuse
    F p_through;                             // probability of sampling that part
    Clearcoat<F> coat;
    Sheen<F> sheen;
    F p_base; // probability of sampling below the layers
};

// Minimal cosine to a shading normal for a viewer to count as in front of it.
constexpr float min_facing = 1e-4f;
// Lower clamp of cosines between the viewer and a surface or microfacet.
constexpr float grazing = 1e-6f;

constexpr bool has_facets(Features s) {
    return s.has(Feature::specular) || s.has(Feature::transmission) || s.has(Feature::diffuse_transmission);
}
constexpr bool has_layers(Features s) { return s.has(Feature::clearcoat) || s.has(Feature::sheen); }

template <class F> Vec<F> flip_z(const Mask<F>& m, const Vec<F>& w) { return {w.x, w.y, select(m, -w.z, w.z)}; }
// wo flipped to the upper side, and clamped from grazing so that no half vector vanishes.
template <class F> Vec<F> upper_wo(const Bsdf<F>& b, const Vec<F>& wo) {
    return {wo.x, wo.y, max(select(b.flipped, -wo.z, wo.z), F(grazing))};
}

} // namespace blush::inline BLUSH_ISA
