// What scattering is computed from and what comes of it: the records that base, layers and their sum (bsdf.h) share.
//
// Local frame: z is the shading normal; directions are unit and point away from the surface. Of a surface that does not
// transmit into a solid, wo.z > 0. Of a solid's (transmission, not thin) z points out of it, and wo.z < 0 is a viewer within.
#pragma once

#include "core/sampling.h"
#include "shading/features.h"
#include "shading/fresnel.h"
#include "shading/microfacet.h"

namespace blush::inline BLUSH_ISA {

// What KHR_materials_* add to the metallic-roughness material. All 0: nothing.
template <class F> struct LayerParams {
    F clearcoat; // share of the surface that is coated
    F clearcoat_roughness;
    Vec<F> clearcoat_normal; // unit, local frame; one that no viewer can be in front of: z
    Vec<F> sheen_color;
    F sheen_roughness;
    F anisotropy;  // makes the base rougher along the local x
    F iridescence; // share of the base that is under a film
    F film_ior, film_thickness; // nanometres
    F diffuse_transmission;     // share of the diffuse part that goes through
    Vec<F> diffuse_transmission_color;
};

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
    LayerParams<F> layers{};
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

// A coat as one viewer sees it: clearcoat.h.
template <class F> struct Clearcoat {
    Basis<F> frame; // around the coat's normal, in the viewer's frame
    Vec<F> wo;      // in that
    F reflected;    // share of the light
    F left;         // for what is below
    F alpha, visible;
    Mask<F> smooth;
    F probability; // of sampling it
};

// Fibres as one viewer sees them: sheen.h.
template <class F> struct Sheen {
    Vec<F> color;
    F strength; // its largest component
    F roughness, alpha;
    F albedo;      // as the fit has it: of white sheen, seen from wo
    F probability; // of sampling it
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
    // Only where S has them:
    Stretch<F> stretch;                      // for alpha
    F iridescence, film_ior, film_thickness; // a film on the facets
    Vec<F> through;                          // albedo of the Lambertian part to the other side, as diffuse
    F p_through;                             // of sampling that part: probability of crossing
    Clearcoat<F> coat;
    Sheen<F> sheen;
    F p_base; // probability of sampling what is below the layers
};

// Cosine to a shading normal from which on a viewer is in front of it.
constexpr float least_facing = 1e-4f;
// Smaller cosines between the viewer and a surface or facet count as this one.
constexpr float grazing = 1e-6f;

constexpr bool has_facets(Features s) {
    return s.has(Feature::specular) || s.has(Feature::transmission) || s.has(Feature::diffuse_transmission);
}
constexpr bool has_layers(Features s) { return s.has(Feature::clearcoat) || s.has(Feature::sheen); }

template <class F> Vec<F> flip_z(const Mask<F>& m, const Vec<F>& w) { return {w.x, w.y, select(m, -w.z, w.z)}; }
// wo on the upper side, and never so grazing that a half vector vanishes.
template <class F> Vec<F> upper_wo(const Bsdf<F>& b, const Vec<F>& wo) {
    return {wo.x, wo.y, max(select(b.flipped, -wo.z, wo.z), F(grazing))};
}

} // namespace blush::inline BLUSH_ISA
