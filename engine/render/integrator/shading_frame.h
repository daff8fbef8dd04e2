// The shading frame of a surface: its interpolated or mapped normal, and the basis in which it scatters.
#pragma once

#include "render/integrator/surface.h"
#include "shading/material.h"

namespace blush::inline BLUSH_ISA {

// The shading normal: interpolated or mapped, flipped to the side of the geometric normal.
template <Features S, class F> Vec<F> shading_normal(const Surface<F>& s, const Vec<F>& ng, const Vec<F>& tangent_normal) {
    Vec<F> ns = select<F>(dot(s.ns, ng) < F(0.f), -s.ns, s.ns);
    if constexpr (S.has(Feature::normal_maps)) {
        if (any(s.has_tangents)) {
            // Normal mapping: the map's normal is in tangent space, the basis (t, b, n). glTF: bitangent = cross(normal, tangent) * w.
            // Gram-Schmidt makes the tangent orthogonal to the interpolated normal.
            const Vec<F> n = s.ns;
            const Vec<F> flat = s.tangent - n * dot(n, s.tangent);
            const F l2 = dot(flat, flat);
            const Vec<F> t = flat / sqrt(max(l2, F(1e-30f)));
            const Vec<F> b = cross(n, t) * s.tangent_sign;
            const Vec<F> mapped = normalize(t * tangent_normal.x + b * tangent_normal.y + n * tangent_normal.z);
            const Vec<F> turned = select<F>(dot(s.ns, ng) < F(0.f), -mapped, mapped);
            ns = select<F>(s.has_tangents && l2 > F(1e-20f) && dot(turned, ng) > F(0.f), turned, ns);
        }
    }
    return ns;
}

// Basis around the shading normal; x is the direction of anisotropy, if the material has any.
template <Features S, class F> Basis<F> shading_frame(const Surface<F>& s, const Vec<F>& ns, const MaterialPoint<F>& material) {
    const Basis<F> any_frame = basis_around(ns);
    if constexpr (!S.has(Feature::anisotropy))
        return any_frame;
    else {
        const Mask<F> stretched = s.has_tangents && material.anisotropy.strength > F(0.f);
        if (!any(stretched)) return any_frame;
        // As in shading_normal; seen from behind, the direction is the same.
        const Vec<F> t = normalize(s.tangent - s.ns * dot(s.ns, s.tangent)), b = cross(s.ns, t) * s.tangent_sign;
        const Vec<F> along = t * material.anisotropy.direction.x + b * material.anisotropy.direction.y;
        const Vec<F> flat = along - ns * dot(ns, along);
        const F l2 = dot(flat, flat);
        const Mask<F> usable = stretched && l2 > F(1e-12f);
        const Vec<F> x = flat / sqrt(select(usable, l2, F(1.f)));
        return {select<F>(usable, x, any_frame.s), select<F>(usable, cross(ns, x), any_frame.t), ns};
    }
}

// The frame in which a surface point scatters.
template <class F> struct ShadingFrame {
    Vec<F> ng, ns;  // unit, world: flipped towards the viewer unless the surface bounds a solid
    Mask<F> behind; // the viewer sees the back of the interpolated or mapped normal: ns is ng
    Basis<F> frame;
    Vec<F> wo; // in `frame`
};
// Sets the parameters of material.bsdf that depend on the frame.
template <Features S, class F> ShadingFrame<F> shading_frame_at(const Surface<F>& surface, MaterialPoint<F>& material,
                                                                const Vec<F>& wo_world, const Mask<F>& front, const Mask<F>& solid) {
    ShadingFrame<F> s;
    s.ng = select<F>(front || solid, surface.ng, -surface.ng);
    const Vec<F> normal = shading_normal<S, F>(surface, s.ng, material.tangent_normal);
    // If the viewer sees the back of the shading normal, uses the geometric normal, except on solids.
    s.behind = !solid && dot(normal, wo_world) < F(min_facing);
    s.ns = select<F>(s.behind, s.ng, normal);
    s.frame = shading_frame<S, F>(surface, s.ns, material);
    s.wo = s.frame.to_local(wo_world);
    // The coat does not follow the normal map of the base.
    if constexpr (S.has(Feature::clearcoat))
        material.bsdf.layers.clearcoat_normal = s.frame.to_local(shading_normal<S, F>(surface, s.ng, material.clearcoat_tangent_normal));
    if constexpr (S.has(Feature::anisotropy))
        material.bsdf.layers.anisotropy = select(surface.has_tangents, material.anisotropy.strength, F(0.f));
    return s;
}

} // namespace blush::inline BLUSH_ISA
