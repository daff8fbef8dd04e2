// Reflectance and refraction at the interface of two dielectrics. All formulas use g^2 = eta^2 - 1 + c^2 (Cook and Torrance
// 1982), with eta^2 - 1 as a separate parameter: no cancellation as eta -> 1, and eta = 1 reflects exactly nothing.
#pragma once

#include "core/math.h"

namespace blush::inline BLUSH_ISA {

// (1 - c)^5: Schlick's interpolation weight from normal (0) to grazing incidence (1).
template <class F> F schlick(const F& c) { return pow5(clamp01(F(1.f - c))); }

// Reflectance at normal incidence of an interface with index ratio `ior`; 1 for 0, the special value of KHR_materials_ior.
template <class F> F normal_reflectance(const F& ior) {
    const F r = (ior - 1.f) / (ior + 1.f);
    return r * r;
}

template <class F> struct Interface {
    F eta;                 // index behind the surface over index on the viewer's side
    F eta_squared_minus_1; // computed without cancellation
};

// The interface between vacuum and a material of index ior >= 1, for a viewer inside or outside the material.
template <class F> Interface<F> interface_seen(const Mask<F>& from_inside, const F& ior) {
    const F excess = (ior - 1.f) * (ior + 1.f);
    return {select(from_inside, 1.f / ior, ior), select(from_inside, -excess / (ior * ior), excess)};
}

// eta times the cosine of the refracted direction; 0 under total internal reflection. c: cosine on the viewer's side.
template <class F> F refracted_g(const Interface<F>& i, const F& c) { return sqrt(max(F(0.f), F(i.eta_squared_minus_1 + c * c))); }
template <class F> Mask<F> totally_reflects(const Interface<F>& i, const F& c) { return i.eta_squared_minus_1 + c * c <= F(0.f); }

// Fresnel's reflectance for unpolarised light; c > 0.
template <class F> F dielectric_reflectance(const Interface<F>& i, const F& c) {
    const F m = i.eta_squared_minus_1;
    const F g = refracted_g(i, c);
    const F sum = c + g;
    const F s = m / (sum * sum);
    const F p = m * (c - 1.f / sum) / ((m + 1.f) * c + g);
    return select(totally_reflects(i, c), F(1.f), min(F(0.5f * (s * s + p * p)), F(1.f)));
}

// The direction into which wo is refracted at a facet with normal h, c = dot(wo, h) > 0, not under total internal reflection.
template <class F> Vec<F> refract(const Interface<F>& i, const Vec<F>& wo, const Vec<F>& h, const F& c) {
    const F c_minus_g = -i.eta_squared_minus_1 / (c + refracted_g(i, c));
    return (h * c_minus_g - wo) / i.eta;
}

} // namespace blush::inline BLUSH_ISA
